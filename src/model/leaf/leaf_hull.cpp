#include <QLineF>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "model/leaf/leaf_hull_private.h"

namespace windfall::model {

namespace {

double cross(QPointF a, QPointF b) { return a.x() * b.y() - a.y() * b.x(); }

double signedArea(const Polygon& closed) {
  double area = 0;
  for (size_t i = 0; i < closed.size(); ++i) area += cross(closed[i], closed[(i + 1) % closed.size()]) / 2;
  return area;
}

/// Where the edges before and after edge i meet when it is left out; nothing where they do not meet beyond it.
std::optional<QPointF> meeting(const Polygon& hull, size_t i) {
  const size_t n = hull.size();
  const QPointF a = hull[(i + n - 1) % n], b = hull[i], c = hull[(i + 1) % n], d = hull[(i + 2) % n];
  const QPointF along = b - a, other = d - c;
  const double turn = cross(along, other);
  if (std::abs(turn) < 1e-9) return std::nullopt;
  const double t = cross(c - a, other) / turn, s = cross(c - a, along) / turn;
  if (t < 1 || s > 0) return std::nullopt;
  return a + t * along;
}

}  // namespace

Polygon outwards(const Polygon& closed, double distance) {
  const size_t n = closed.size();
  if (n < 3) return closed;
  const double side = signedArea(closed) > 0 ? 1 : -1;
  const auto normal = [&](size_t i) {
    const QPointF along = closed[(i + 1) % n] - closed[i];
    const double length = std::max(1e-9, std::hypot(along.x(), along.y()));
    return QPointF(along.y(), -along.x()) * (side / length);
  };
  Polygon result;
  for (size_t i = 0; i < n; ++i) {
    const QPointF before = normal((i + n - 1) % n), after = normal(i), sum = before + after;
    const double square = QPointF::dotProduct(sum, sum);
    const double scale = square > 1e-9 ? 2 * distance / square : 0;
    const double reach = scale * std::sqrt(square), most = 3 * distance;
    result.push_back(closed[i] + sum * (reach > most ? scale * most / reach : scale));
  }
  return result;
}

Polygon enclosingPolygon(const Polygon& points, size_t corners, double distance) {
  std::vector<cv::Point2f> from, to;
  for (const QPointF& p : points) from.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()));
  cv::convexHull(from, to);
  Polygon hull;
  for (const cv::Point2f& p : to) hull.emplace_back(p.x, p.y);
  while (hull.size() > std::max<size_t>(corners, 3)) {
    double least = 1e30;
    size_t best = hull.size();
    QPointF corner;
    for (size_t i = 0; i < hull.size(); ++i) {
      const std::optional<QPointF> place = meeting(hull, i);
      if (!place) continue;
      const double area = std::abs(cross(*place - hull[i], hull[(i + 1) % hull.size()] - hull[i])) / 2;
      if (area < least) least = area, best = i, corner = *place;
    }
    if (best == hull.size()) break;
    hull[best] = corner;
    hull.erase(hull.begin() + static_cast<std::ptrdiff_t>((best + 1) % hull.size()));
  }
  return outwards(hull, distance);
}

}  // namespace windfall::model
