#include "model/leaf/contour.h"

#include <QLineF>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "model/leaf/image_cv_private.h"

namespace windfall::model {

namespace {

double distanceToSegment(QPointF point, QPointF from, QPointF to) {
  const QPointF along = to - from;
  const double square = QPointF::dotProduct(along, along);
  const double t = square > 0 ? std::clamp(QPointF::dotProduct(point - from, along) / square, 0.0, 1.0) : 0;
  return QLineF(point, from + t * along).length();
}

/// RDP of an open polyline with an explicit stack; appends all but the last point.
void simplifyOpen(const Polygon& line, double epsilon, Polygon& result) {
  std::vector<char> keep(line.size(), 0);
  keep.front() = keep.back() = 1;
  std::vector<std::pair<size_t, size_t>> open{{0, line.size() - 1}};
  while (!open.empty()) {
    const auto [first, last] = open.back();
    open.pop_back();
    double farthest = epsilon;
    size_t split = 0;
    for (size_t i = first + 1; i < last; ++i) {
      const double distance = distanceToSegment(line[i], line[first], line[last]);
      if (distance > farthest) {
        farthest = distance;
        split = i;
      }
    }
    if (split == 0) continue;
    keep[split] = 1;
    open.emplace_back(first, split);
    open.emplace_back(split, last);
  }
  for (size_t i = 0; i + 1 < line.size(); ++i) {
    if (keep[i]) result.push_back(line[i]);
  }
}

size_t nearest(const Polygon& polygon, QPointF place) {
  size_t best = 0;
  for (size_t i = 1; i < polygon.size(); ++i) {
    if (QLineF(polygon[i], place).length() < QLineF(polygon[best], place).length()) best = i;
  }
  return best;
}

}  // namespace

Polygon traceBorder(const QImage& mask) {
  std::vector<std::vector<cv::Point>> contours;
  cv::findContours(grayView(mask), contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  const auto largest = std::max_element(contours.begin(), contours.end(), [](const auto& a, const auto& b) {
    return cv::contourArea(a) < cv::contourArea(b);
  });
  if (largest == contours.end()) return {};
  // Image y points down: a negative signed area there is clockwise to the eye.
  if (cv::contourArea(*largest, true) > 0) std::reverse(largest->begin(), largest->end());
  Polygon border;
  border.reserve(largest->size());
  for (const cv::Point& point : *largest) border.emplace_back(point.x, point.y);
  return border;
}

Polygon mergeCollinear(const Polygon& closed) {
  Polygon result;
  const size_t n = closed.size();
  for (size_t i = 0; i < n; ++i) {
    const QPointF before = closed[i] - closed[(i + n - 1) % n], after = closed[(i + 1) % n] - closed[i];
    if (before != after) result.push_back(closed[i]);
  }
  return result;
}

Polygon simplifyLine(const Polygon& line, double epsilon) {
  if (line.size() < 3) return line;
  Polygon result;
  simplifyOpen(line, epsilon, result);
  result.push_back(line.back());
  return result;
}

Polygon simplifyClosed(const Polygon& closed, double epsilon, QPointF first, QPointF second) {
  if (closed.size() < 4) return closed;
  const size_t n = closed.size();
  const size_t a = nearest(closed, first);
  size_t b = nearest(closed, second);
  if (a == b) b = (a + n / 2) % n;
  const auto stretch = [&](size_t from, size_t to) {
    Polygon part;
    for (size_t i = from; i != to; i = (i + 1) % n) part.push_back(closed[i]);
    part.push_back(closed[to]);
    return part;
  };
  Polygon result;
  simplifyOpen(stretch(a, b), epsilon, result);
  simplifyOpen(stretch(b, a), epsilon, result);
  return result;
}

}  // namespace windfall::model
