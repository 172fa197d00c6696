#include "model/leaf/vein_curve.h"

#include <algorithm>
#include <cmath>

namespace windfall::model {

namespace {

constexpr double kSpacing = 2;  // px between samples

double length(QPointF v) { return std::hypot(v.x(), v.y()); }

int samplesOf(double distance) { return std::max(1, static_cast<int>(distance / kSpacing)); }

}  // namespace

double lengthOf(const Polygon& line) {
  double sum = 0;
  for (size_t i = 1; i < line.size(); ++i) sum += length(line[i] - line[i - 1]);
  return sum;
}

QPointF deCasteljau(Polygon control, double t) {
  if (control.empty()) return {};
  for (size_t left = control.size() - 1; left > 0; --left) {
    for (size_t i = 0; i < left; ++i) control[i] = (1 - t) * control[i] + t * control[i + 1];
  }
  return control.front();
}

Polygon bezierCurve(const Polygon& control) {
  if (control.size() < 3) return control;
  const int samples = samplesOf(lengthOf(control));
  Polygon curve;
  for (int i = 0; i < samples; ++i) curve.push_back(deCasteljau(control, static_cast<double>(i) / samples));
  curve.push_back(control.back());
  return curve;
}

Polygon smoothCurve(const Polygon& points) {
  if (points.size() < 3) return points;
  const auto at = [&](std::ptrdiff_t i) {
    const auto last = static_cast<std::ptrdiff_t>(points.size()) - 1;
    if (i < 0) return 2 * points.front() - points[1];
    if (i > last) return 2 * points.back() - points[points.size() - 2];
    return points[static_cast<size_t>(i)];
  };
  Polygon curve;
  for (std::ptrdiff_t i = 0; i + 1 < static_cast<std::ptrdiff_t>(points.size()); ++i) {
    const QPointF a = at(i - 1), b = at(i), c = at(i + 1), d = at(i + 2);
    const int samples = samplesOf(length(c - b));
    for (int k = 0; k < samples; ++k) {
      const double t = static_cast<double>(k) / samples;
      curve.push_back(((1 - t) * (1 - t) * (1 - t) * a + (3 * t * t * t - 6 * t * t + 4) * b +
                       (-3 * t * t * t + 3 * t * t + 3 * t + 1) * c + t * t * t * d) /
                      6);
    }
  }
  curve.push_back(points.back());
  curve.front() = points.front();
  return curve;
}

Polygon throughPoints(const Polygon& points) {
  if (points.size() < 3) return points;
  Polygon curve;
  const size_t last = points.size() - 1;
  for (size_t i = 0; i < last; ++i) {
    const QPointF b = points[i], c = points[i + 1];
    const double gap = length(c - b);
    curve.push_back(b);
    if (gap <= 2 * kSpacing) continue;
    const QPointF a = i > 0 ? points[i - 1] : 2 * b - c, d = i + 1 < last ? points[i + 2] : 2 * c - b;
    // Knots by the square root of the distances: no loops and no overshoot beside short pieces.
    const double t1 = std::sqrt(std::max(1e-6, length(b - a))), t2 = t1 + std::sqrt(gap),
                 t3 = t2 + std::sqrt(std::max(1e-6, length(d - c)));
    const int samples = samplesOf(gap);
    for (int k = 1; k < samples; ++k) {
      const double t = t1 + (t2 - t1) * k / samples;
      const QPointF ab = (t1 - t) / t1 * a + t / t1 * b, bc = ((t2 - t) * b + (t - t1) * c) / (t2 - t1),
                    cd = ((t3 - t) * c + (t - t2) * d) / (t3 - t2);
      const QPointF abc = (t2 - t) / t2 * ab + t / t2 * bc, bcd = ((t3 - t) * bc + (t - t1) * cd) / (t3 - t1);
      curve.push_back(((t2 - t) * abc + (t - t1) * bcd) / (t2 - t1));
    }
  }
  curve.push_back(points.back());
  return curve;
}

}  // namespace windfall::model
