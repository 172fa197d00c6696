// Several leaves in one photo.
#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "model/leaf/image_cv_private.h"
#include "model/leaf/mask.h"
#include "model/leaf/mask_edit.h"
#include "model/leaf/touching_leaves_private.h"

namespace windfall::model {

namespace {

constexpr int kMostLeaves = 64;
constexpr double kLeastShare = 0.2;  // of the largest leaf's area

}  // namespace

std::vector<QImage> separateLeaves(const QImage& photo, const QImage& found) {
  std::vector<QImage> leaves;
  cv::Mat4b rest = rgbaView(photo).clone();
  QImage mask = found;
  double largest = 0;
  std::vector<std::pair<double, QImage>> bySize;
  for (int round = 0; round < kMostLeaves; ++round) {
    const cv::Mat1b white = grayView(mask) > 127;
    if (cv::countNonZero(white) < std::max(64.0, kLeastShare * largest)) break;
    for (const cv::Mat1b& leaf : leavesOf(white, kLeastShare)) {
      const double area = cv::countNonZero(leaf);
      const cv::Rect box = cv::boundingRect(leaf);
      const bool cut = box.x <= 0 || box.y <= 0 || box.br().x >= leaf.cols || box.br().y >= leaf.rows;
      if (cut && !bySize.empty()) continue;
      bySize.emplace_back(area, toGray(leaf));
      largest = std::max(largest, area);
    }
    // What was found becomes ground: the colour around it is laid over it, and the next leaf stands out most.
    cv::Mat1b wide, ring;
    const int reach = std::max(3, std::max(white.cols, white.rows) / 120);
    cv::dilate(white, wide, cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * reach + 1, 2 * reach + 1}));
    cv::dilate(wide, ring, cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * reach + 1, 2 * reach + 1}));
    ring &= ~wide;
    rest.setTo(cv::mean(rest, ring), wide);
    Progress progress;
    const Result<QImage> next = automaticMask(toRgba(rest), {}, progress);
    if (!next) break;
    mask = *next;
  }
  std::stable_sort(bySize.begin(), bySize.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  for (auto& [area, leaf] : bySize) {
    if (area >= kLeastShare * largest) leaves.push_back(std::move(leaf));
  }
  return leaves;
}

int leavesInMask(const QImage& mask) { return static_cast<int>(leavesOf(grayView(mask) > 127, kLeastShare).size()); }

}  // namespace windfall::model
