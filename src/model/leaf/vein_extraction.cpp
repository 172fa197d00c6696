#include "model/leaf/vein_extraction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <queue>

#include "model/leaf/image_cv_private.h"
#include "model/leaf/vein_ridges_private.h"

namespace windfall::model {

namespace {

constexpr int kWorkSide = 512;

/// How many pixels pass each pixel on their cheapest way to the root.
cv::Mat1i votes(const cv::Mat1f& cost, const cv::Mat1b& leaf, cv::Point root) {
  cv::Mat1f reached(cost.size(), 1e30f);
  cv::Mat1i before(cost.size(), -1), count = cv::Mat1i::zeros(cost.size());
  std::vector<int> order;
  using Item = std::pair<float, int>;
  std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
  reached(root) = 0;
  queue.emplace(0.f, root.y * cost.cols + root.x);
  while (!queue.empty()) {
    const auto [distance, index] = queue.top();
    queue.pop();
    const cv::Point here(index % cost.cols, index / cost.cols);
    if (distance > reached(here)) continue;
    order.push_back(index);
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const cv::Point next = here + cv::Point(dx, dy);
        if (next.x < 0 || next.y < 0 || next.x >= cost.cols || next.y >= cost.rows || !leaf(next)) continue;
        const float way = distance + (dx != 0 && dy != 0 ? 1.4142f : 1.f) * cost(next);
        if (way >= reached(next)) continue;
        reached(next) = way;
        before(next) = index;
        queue.emplace(way, next.y * cost.cols + next.x);
      }
    }
  }
  for (size_t i = order.size(); i-- > 0;) {
    const int index = order[i], parent = before(index / cost.cols, index % cost.cols);
    const int own = ++count(index / cost.cols, index % cost.cols);
    if (parent >= 0) count(parent / cost.cols, parent % cost.cols) += own;
  }
  return count;
}

}  // namespace

std::vector<Tissue> extractVeins(const QImage& photo, std::vector<Tissue> types, QPoint root, double detail) {
  const int width = photo.width(), height = photo.height();
  cv::Mat1b leafFull(height, width);
  std::transform(types.begin(), types.end(), leafFull.begin(),
                 [](Tissue type) { return type == Tissue::Outside ? uchar{0} : uchar{255}; });
  const double scale = std::min(1.0, static_cast<double>(kWorkSide) / std::max(width, height));
  cv::Mat3f lab;
  cv::resize(toLab(photo), lab, {}, scale, scale, cv::INTER_AREA);
  cv::Mat1b leaf;
  cv::resize(leafFull, leaf, lab.size(), 0, 0, cv::INTER_AREA);
  leaf = leaf > 127;
  VeinRidges ridges = veinRidges(lab, leaf);
  dropMarginEdges(ridges, leaf);
  const cv::Mat1f& ridge = ridges.strength;
  cv::Mat1f cost(ridge.size());
  for (int y = 0; y < cost.rows; ++y) {
    for (int x = 0; x < cost.cols; ++x) cost(y, x) = 1 / (0.04f + std::min(1.f, ridge(y, x)));
  }
  cv::Point start(std::clamp(static_cast<int>(root.x() * scale), 0, leaf.cols - 1),
                  std::clamp(static_cast<int>(root.y() * scale), 0, leaf.rows - 1));
  if (!leaf(start)) {
    double nearest = 1e30;
    const cv::Point wanted = start;
    for (int y = 0; y < leaf.rows; ++y) {
      for (int x = 0; x < leaf.cols; ++x) {
        const double distance = cv::norm(cv::Point(x, y) - wanted);
        if (leaf(y, x) && distance < nearest) nearest = distance, start = {x, y};
      }
    }
  }
  const cv::Mat1i passed = votes(cost, leaf, start);
  const double least = detail * cv::countNonZero(leaf);
  cv::Mat1b veins = passed > least;
  cv::Mat1b full;
  cv::resize(veins, full, {width, height}, 0, 0, cv::INTER_LINEAR);
  auto vein = full.begin();
  for (Tissue& type : types) {
    if (type != Tissue::Outside) type = *vein > 127 ? Tissue::Vein : Tissue::Blade;
    ++vein;
  }
  return types;
}

}  // namespace windfall::model
