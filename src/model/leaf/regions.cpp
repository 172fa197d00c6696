#include "model/leaf/regions.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace windfall::model {

namespace {

/// Distance to the veins inside the leaf, in pixels of a leaf picture of 512 px.
cv::Mat1f veinDistance(const std::vector<Tissue>& types, QSize size) {
  cv::Mat1b tissue(size.height(), size.width());
  std::transform(types.begin(), types.end(), tissue.begin(),
                 [](Tissue type) { return type == Tissue::Blade ? uchar{255} : uchar{0}; });
  cv::copyMakeBorder(tissue, tissue, 1, 1, 1, 1, cv::BORDER_CONSTANT, 0);
  cv::Mat1f distance;
  cv::distanceTransform(tissue, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  const double unit = std::max(size.width(), size.height()) / 512.0;
  cv::GaussianBlur(distance, distance, {}, 2 * unit);
  return distance(cv::Rect(1, 1, size.width(), size.height())) / unit;
}

}  // namespace

std::vector<QPointF> automaticMarkers(const std::vector<Tissue>& types, QSize size) {
  const cv::Mat1f distance = veinDistance(types, size);
  const int window = std::max(3, static_cast<int>(25.0 * std::max(size.width(), size.height()) / 512) | 1);
  cv::Mat1f highest;
  cv::dilate(distance, highest, cv::getStructuringElement(cv::MORPH_RECT, {window, window}));
  cv::Mat1b peaks = (distance >= highest) & (distance > 5);
  // A plateau is one marker.
  cv::Mat1i labels, stats;
  cv::Mat1d centres;
  const int count = cv::connectedComponentsWithStats(peaks, labels, stats, centres, 8);
  std::vector<QPointF> markers;
  for (int i = 1; i < count; ++i) markers.emplace_back(centres(i, 0), centres(i, 1));
  if (markers.empty()) {
    // A leaf too small for a maximum above the limit is one region.
    cv::Point best;
    cv::minMaxLoc(distance, nullptr, nullptr, nullptr, &best);
    markers.emplace_back(best.x, best.y);
  }
  return markers;
}

LabelField growRegions(const std::vector<Tissue>& types, QSize size, const std::vector<QPointF>& markers) {
  const cv::Mat1f distance = veinDistance(types, size);
  const int width = size.width(), height = size.height();
  double deepest = 1;
  cv::minMaxLoc(distance, nullptr, &deepest);
  cv::Mat1i labels(height, width, 0);
  const auto isLeaf = [&](int x, int y) {
    return types[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)] != Tissue::Outside;
  };
  // Flooded by height from the bottoms of the basins (Meyer): the veins are the ridges where two floods meet.
  // cv::watershed orders by the difference of neighbours, which is the same everywhere on these slopes.
  constexpr int kLevels = 1024;
  std::vector<std::vector<cv::Point>> open(kLevels);
  const auto levelOf = [&](int x, int y) {
    return static_cast<size_t>(std::clamp((1 - distance(y, x) / deepest) * (kLevels - 1), 0.0, kLevels - 1.0));
  };
  const int dot = std::max(1, std::max(width, height) / 200);
  for (size_t i = 0; i < markers.size(); ++i) {
    const int mx = static_cast<int>(markers[i].x()), my = static_cast<int>(markers[i].y());
    for (int y = std::max(0, my - dot); y <= std::min(height - 1, my + dot); ++y) {
      for (int x = std::max(0, mx - dot); x <= std::min(width - 1, mx + dot); ++x) {
        if (!isLeaf(x, y) || labels(y, x) != 0) continue;
        labels(y, x) = static_cast<int>(i + 1);
        open[levelOf(x, y)].emplace_back(x, y);
      }
    }
  }
  for (size_t level = 0; level < open.size(); ++level) {
    for (size_t k = 0; k < open[level].size(); ++k) {
      const cv::Point here = open[level][k];
      for (const cv::Point& step : {cv::Point(1, 0), cv::Point(-1, 0), cv::Point(0, 1), cv::Point(0, -1)}) {
        const cv::Point next = here + step;
        if (next.x < 0 || next.y < 0 || next.x >= width || next.y >= height) continue;
        if (!isLeaf(next.x, next.y) || labels(next) != 0) continue;
        labels(next) = labels(here);
        open[std::max(level, levelOf(next.x, next.y))].push_back(next);
      }
    }
  }
  // Parts of the leaf that no flood reached go to the nearest region.
  cv::Mat1b dry(height, width);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      dry(y, x) = labels(y, x) > 0 ? 0 : 255;
    }
  }
  cv::Mat1f toRegion;
  cv::Mat1i nearest;
  cv::distanceTransform(dry, toRegion, nearest, cv::DIST_L2, 5, cv::DIST_LABEL_PIXEL);
  std::vector<int> regionOf(1, 0);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (dry(y, x)) continue;
      const auto label = static_cast<size_t>(nearest(y, x));
      if (label >= regionOf.size()) regionOf.resize(label + 1, 0);
      regionOf[label] = labels(y, x);
    }
  }
  LabelField field{size, std::vector<qint32>(types.size(), 0), static_cast<int>(markers.size())};
  for (size_t i = 0; i < types.size(); ++i) {
    if (types[i] == Tissue::Outside) continue;
    const auto label = static_cast<size_t>(nearest(static_cast<int>(i) / width, static_cast<int>(i) % width));
    field.values[i] = std::max(1, label < regionOf.size() ? regionOf[label] : 1);
  }
  return field;
}

}  // namespace windfall::model
