#include "model/leaf/octave_contrast.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace windfall::model {

namespace {

constexpr double kOctaves = 5;               ///< of a leaf of 512 px
constexpr double kShare = 0.6, kMost = 1.5;  ///< of the lack that is given back (a power), and the largest gain
constexpr double kLeast = 0.9;
constexpr float kStrong = 1.2f;  ///< deviations from which on a place is left as it is
constexpr float kNoise = 0.02f;  ///< L*: less than that is no contrast

/// Octaves of the lightness over a blade; a level is half as large as the one before.
struct Octaves {
  std::vector<cv::Mat1f> band, weight;
  std::vector<float> deviation;
};

cv::Mat1f meansOf(const cv::Mat1f& sum, const cv::Mat1f& weight) { return sum / cv::max(weight, 1e-4f); }

Octaves octavesOf(const ColouredLeaf& leaf, size_t count) {
  const LabelField& regions = leaf.structure.regions;
  const QSize size = leaf.structure.distance.size;
  cv::Mat1f weight(size.height(), size.width(), 0.f), sum(size.height(), size.width(), 0.f);
  auto on = weight.begin(), lightness = sum.begin();
  for (size_t i = 0; i < regions.values.size(); ++i, ++on, ++lightness) {
    if (regions.values[i] > 0 && regions.values[i] != regions.petiole) *on = 1, *lightness = leaf.lab[3 * i];
  }
  Octaves octaves;
  for (size_t n = 0; n < count; ++n) {
    cv::Mat1f coarse, coarseWeight, back, backWeight;
    cv::pyrDown(sum, coarse);
    cv::pyrDown(weight, coarseWeight);
    cv::pyrUp(coarse, back, sum.size());
    cv::pyrUp(coarseWeight, backWeight, sum.size());
    cv::Mat1f band = meansOf(sum, weight) - meansOf(back, backWeight);
    band.setTo(0, weight < 0.5f);
    const double pixels = std::max(1, cv::countNonZero(weight >= 0.5f));
    octaves.deviation.push_back(static_cast<float>(std::sqrt(band.dot(band) / pixels)));
    octaves.band.push_back(band);
    octaves.weight.push_back(weight);
    sum = coarse;
    weight = coarseWeight;
  }
  return octaves;
}

}  // namespace

std::vector<float> restoreContrast(const ColouredLeaf& made, const ColouredLeaf& example) {
  const QSize size = made.structure.distance.size;
  const double finer = std::log2(std::max(size.width(), size.height()) / 512.0);
  const auto count = static_cast<size_t>(std::clamp<long>(std::lround(kOctaves + finer), 2, 8));
  Octaves both[2];
#pragma omp parallel for schedule(static, 1)
  for (int leaf = 0; leaf < 2; ++leaf) both[leaf] = octavesOf(leaf == 0 ? made : example, count);
  const Octaves &has = both[0], &wanted = both[1];
  cv::Mat1f add;
  for (size_t n = count; n-- > 0;) {
    const double ratio = (wanted.deviation[n] + kNoise) / (has.deviation[n] + kNoise);
    const auto gain = static_cast<float>(std::clamp(std::pow(ratio, kShare), kLeast, kMost)) - 1;
    const cv::Mat1f& band = has.band[n];
    cv::Mat1f here(band.size(), 0.f);
    if (!add.empty()) cv::pyrUp(add, here, band.size());
    const float strong = kStrong * (wanted.deviation[n] + kNoise);
    for (int y = 0; y < band.rows; ++y) {
      for (int x = 0; x < band.cols; ++x) {
        const float beside = band(y, x) / strong, squared = beside * beside;
        here(y, x) += gain * band(y, x) / (1 + squared * squared);
      }
    }
    add = here;
  }
  std::vector<float> result = made.lab;
  auto by = add.begin();
  for (size_t i = 0; i < made.structure.regions.values.size(); ++i, ++by) {
    const qint32 region = made.structure.regions.values[i];
    if (region > 0 && region != made.structure.regions.petiole) result[3 * i] += *by;
  }
  return result;
}

}  // namespace windfall::model
