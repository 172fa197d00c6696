#include "model/leaf/petiole_region.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace windfall::model {

namespace {

constexpr double kReach = 1.8;  ///< half widths that a petiole may be wider in places

/// Half the width of the leaf along a line, px: the median over its points.
double halfWidth(const cv::Mat1b& leaf, const std::vector<QPointF>& line) {
  cv::Mat1f depth;
  cv::distanceTransform(leaf, depth, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  std::vector<float> depths;
  for (size_t i = 0; i + 1 < line.size(); ++i) {
    const int x = static_cast<int>(std::lround(line[i].x())), y = static_cast<int>(std::lround(line[i].y()));
    if (x >= 0 && y >= 0 && x < leaf.cols && y < leaf.rows && leaf(y, x)) depths.push_back(depth(y, x));
  }
  if (depths.empty()) return 0;
  const auto middle = depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2);
  std::nth_element(depths.begin(), middle, depths.end());
  return *middle;
}

}  // namespace

void setPetioleApart(LabelField& regions, const std::vector<QPointF>& petiole) {
  const int width = regions.size.width(), height = regions.size.height();
  if (petiole.size() < 2 || width < 1 || height < 1) return;
  cv::Mat1b leaf(height, width);
  auto value = regions.values.begin();
  for (uchar& pixel : leaf) pixel = *value++ > 0 ? 255 : 0;
  const double half = halfWidth(leaf, petiole);
  if (half <= 0) return;
  // Everything near the line, but for what lies beyond its end at the root.
  cv::Mat1b band(height, width, uchar{0});
  std::vector<cv::Point> points;
  for (const QPointF& p : petiole)
    points.emplace_back(static_cast<int>(std::lround(p.x())), static_cast<int>(std::lround(p.y())));
  const double reach = kReach * half + 1;
  cv::polylines(band, points, false, 255, std::max(1, static_cast<int>(std::lround(2 * reach))));
  const QPointF root = petiole.back();
  size_t before = petiole.size() - 1;
  while (before > 0 && std::hypot(petiole[before].x() - root.x(), petiole[before].y() - root.y()) < 4 * half) --before;
  const QPointF inward = root - petiole[before];
  std::vector<size_t> own;
  size_t pixels = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (!leaf(y, x)) continue;
      ++pixels;
      if (!band(y, x)) continue;
      const QPointF from = QPointF(x, y) - root;
      const bool atRoot = std::hypot(from.x(), from.y()) < 3 * reach;
      if (atRoot && QPointF::dotProduct(from, inward) > 0) continue;
      own.push_back(static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x));
    }
  }
  if (own.size() < 8 || 2 * own.size() > pixels) return;
  regions.petiole = ++regions.count;
  for (const size_t i : own) regions.values[i] = regions.petiole;
}

}  // namespace windfall::model
