#include "model/leaf/small_leaf.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace windfall::model {

namespace {

constexpr double kBlur = 8;  // px at 512: what is narrower is detail

QSize sizeOf(QSize full, double factor) {
  return {std::max(1, static_cast<int>(std::lround(full.width() / factor))),
          std::max(1, static_cast<int>(std::lround(full.height() / factor)))};
}

/// Where the pixels of one small pixel begin and end along one side.
struct Block {
  int from, to, middle;
};

std::vector<Block> blocksOf(int full, int small) {
  std::vector<Block> blocks;
  for (int i = 0; i < small; ++i) {
    const auto place = [&](double at) {
      return std::clamp(static_cast<int>(at * full / small), 0, std::max(0, full - 1));
    };
    const int from = place(i);
    blocks.push_back({from, std::max(from + 1, std::min(full, place(i + 1))), place(i + 0.5)});
  }
  return blocks;
}

LeafStructure smaller(const LeafStructure& full, QSize size) {
  const QSize whole = full.distance.size;
  LeafStructure small;
  small.distance = {size, {}, full.distance.unit};
  small.veinDistance = {size, {}, full.veinDistance.unit};
  small.regions = {size, {}, full.regions.count, full.regions.petiole, full.regions.wholes};
  if (full.regions.values.empty()) return small;
  const size_t pixels = static_cast<size_t>(size.width()) * static_cast<size_t>(size.height());
  small.distance.values.assign(pixels, 0.f);
  small.veinDistance.values.assign(pixels, 0.f);
  small.regions.values.assign(pixels, 0);
  const std::vector<Block> columns = blocksOf(whole.width(), size.width());
  const std::vector<Block> rows = blocksOf(whole.height(), size.height());
  size_t at = 0;
  for (const Block& row : rows) {
    for (const Block& column : columns) {
      const auto index = [&](int x, int y) {
        return static_cast<size_t>(y) * static_cast<size_t>(whole.width()) + static_cast<size_t>(x);
      };
      const size_t n = at++;
      const size_t middle = index(column.middle, row.middle);
      if (full.regions.values[middle] <= 0) continue;
      small.regions.values[n] = full.regions.values[middle];
      float sum = 0, veins = 0, count = 0;
      bool vein = false;
      for (int y = row.from; y < row.to; ++y) {
        for (int x = column.from; x < column.to; ++x) {
          const size_t i = index(x, y);
          if (full.regions.values[i] <= 0) continue;
          sum += full.distance.values[i];
          veins += full.veinDistance.values[i];
          vein = vein || full.veinDistance.values[i] <= 0;
          ++count;
        }
      }
      small.distance.values[n] = sum / count;
      small.veinDistance.values[n] = vein ? 0 : veins / count;
    }
  }
  return small;
}

/// Colours of pixels that weigh something; 0 elsewhere.
std::vector<float> meansOf(const cv::Mat3f& sum, const cv::Mat1f& weight) {
  std::vector<float> result;
  result.reserve(3 * sum.total());
  auto share = weight.begin();
  for (const cv::Vec3f& colour : sum) {
    for (int c = 0; c < 3; ++c) result.push_back(*share > 1e-4f ? colour[c] / *share : 0.f);
    ++share;
  }
  return result;
}

}  // namespace

double smallFactor(QSize size) {
  return std::max(1.0, std::max(size.width(), size.height()) / static_cast<double>(kSmallSide));
}

LeafStages smallStages(const LeafStages& stages, double factor) {
  LeafStages small;
  small.frame = stages.frame;
  small.scale = stages.scale / factor;
  small.root = stages.root;
  small.tip = stages.tip;
  small.grown = smaller(stages.grown, sizeOf(stages.grown.distance.size, factor));
  small.seen = smaller(stages.seen, sizeOf(stages.seen.distance.size, factor));
  small.made.id = stages.made.id;
  small.made.parameters = stages.made.parameters;
  small.made.regionPairs = stages.made.regionPairs;
  small.reached = stages.reached;
  for (JoinedLeaf leaf : stages.joined) {
    const QRect place = leaf.place;
    leaf.place = QRect(QPoint(static_cast<int>(place.x() / factor), static_cast<int>(place.y() / factor)),
                       QSize(std::max(1, static_cast<int>(place.width() / factor)),
                             std::max(1, static_cast<int>(place.height() / factor)))) &
                 QRect(QPoint(0, 0), small.seen.distance.size);
    leaf.scale /= factor;
    leaf.root /= factor;
    leaf.tip /= factor;
    small.joined.push_back(leaf);
  }
  return small;
}

std::vector<float> smallColours(const std::vector<float>& lab, const LabelField& full, QSize small) {
  const cv::Size size(small.width(), small.height());
  cv::Mat3f sum(full.size.height(), full.size.width(), cv::Vec3f(0, 0, 0));
  cv::Mat1f weight(full.size.height(), full.size.width(), 0.f);
  auto colour = sum.begin();
  auto on = weight.begin();
  for (size_t i = 0; i < full.values.size(); ++i, ++colour, ++on) {
    if (full.values[i] > 0) *colour = {lab[3 * i], lab[3 * i + 1], lab[3 * i + 2]}, *on = 1;
  }
  cv::Mat3f smallSum;
  cv::Mat1f smallWeight;
  cv::resize(sum, smallSum, size, 0, 0, cv::INTER_AREA);
  cv::resize(weight, smallWeight, size, 0, 0, cv::INTER_AREA);
  return meansOf(smallSum, smallWeight);
}

std::vector<float> withoutDetail(const std::vector<float>& lab, const LabelField& regions, double longSide) {
  cv::Mat3f sum(regions.size.height(), regions.size.width(), cv::Vec3f(0, 0, 0));
  cv::Mat1f weight(regions.size.height(), regions.size.width(), 0.f);
  auto colour = sum.begin();
  auto on = weight.begin();
  for (size_t i = 0; i < regions.values.size(); ++i, ++colour, ++on) {
    if (regions.values[i] <= 0 || regions.values[i] == regions.petiole) continue;
    *colour = {lab[3 * i], lab[3 * i + 1], lab[3 * i + 2]};
    *on = 1;
  }
  const double sigma = kBlur * longSide / 512;
  cv::GaussianBlur(sum, sum, {}, sigma, sigma, cv::BORDER_CONSTANT);
  cv::GaussianBlur(weight, weight, {}, sigma, sigma, cv::BORDER_CONSTANT);
  return meansOf(sum, weight);
}

}  // namespace windfall::model
