#include "model/leaf/vein_flow.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <utility>

namespace windfall::model {

namespace {

constexpr int kSide = 512;  ///< px: finer pictures are thinned, the flow is smooth along a vein

}  // namespace

std::vector<float> veinFlow(const LeafStructure& structure) {
  const int width = structure.distance.size.width(), height = structure.distance.size.height();
  const int step = std::max(1, std::max(width, height) / kSide);
  const int columns = (width + step - 1) / step, rows = (height + step - 1) / step;
  constexpr float kOutside = 1e9f;
  cv::Mat1f distance(rows, columns, kOutside), flow(rows, columns, 0.f);
  std::vector<std::pair<float, int>> order;
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      const size_t i = static_cast<size_t>(y * step) * static_cast<size_t>(width) + static_cast<size_t>(x * step);
      if (structure.regions.values[i] <= 0) continue;
      distance(y, x) = structure.distance.values[i];
      flow(y, x) = 1;
      order.emplace_back(distance(y, x), y * columns + x);
    }
  }
  std::sort(order.begin(), order.end(), std::greater<>());
  for (const auto& [here, index] : order) {
    const int x = index % columns, y = index / columns;
    float steepest = 0;
    cv::Point next(-1, -1);
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const cv::Point to(x + dx, y + dy);
        if (to.x < 0 || to.y < 0 || to.x >= columns || to.y >= rows || distance(to) >= kOutside) continue;
        const float fall = (here - distance(to)) / (dx != 0 && dy != 0 ? 1.4142f : 1.f);
        if (fall > steepest) steepest = fall, next = to;
      }
    }
    if (next.x >= 0) flow(next) += flow(y, x);
  }
  flow /= std::max<double>(1, static_cast<double>(order.size()));
  // All that flows through a vein keeps to one line of its pixels; the others share its standing.
  cv::dilate(flow, flow, cv::getStructuringElement(cv::MORPH_RECT, {5, 5}));
  std::vector<float> result(static_cast<size_t>(width) * static_cast<size_t>(height));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      result[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)] = flow(y / step, x / step);
    }
  }
  return result;
}

}  // namespace windfall::model
