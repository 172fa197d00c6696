#include "model/leaf/leaf_tones.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>

#include "model/leaf/small_leaf.h"

namespace windfall::model {

namespace {

constexpr double kEnds = 0.03;  ///< share of the places at either end that do not count
/// Variance that every leaf has at least, along the colour of thicker and thinner blades.
constexpr double kOwnVariance = 0.25;
constexpr double kThickness = 16;  ///< added to L* for that direction: a dark leaf's hue does not run away
constexpr float kBeyond = 0.2f;    ///< of a shift: how far tones may leave those of the example
constexpr double kMiddle = 0.12;   ///< of the length: how softly the halves pass into each other
constexpr double kHalf = std::numbers::pi / 4, kEnd = 3 * std::numbers::pi / 8;

using Vec = cv::Vec3d;

}  // namespace

LeafTones measureTones(const LabelField& regions, const std::vector<float>& lab, double longSide) {
  const std::vector<float> low = withoutDetail(lab, regions, longSide);
  std::vector<Vec> tones;
  Vec mean(0, 0, 0);
  for (size_t i = 0; i < regions.values.size(); ++i) {
    if (regions.values[i] <= 0 || regions.values[i] == regions.petiole) continue;
    tones.emplace_back(low[3 * i], low[3 * i + 1], low[3 * i + 2]);
    mean += tones.back();
  }
  LeafTones result;
  if (tones.empty()) return result;
  mean /= static_cast<double>(tones.size());
  Vec thickness(mean[0] + kThickness, mean[1], mean[2]);
  thickness /= cv::norm(thickness);
  cv::Mat1d covariance = cv::Mat1d::zeros(3, 3), variances, directions;
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) {
      for (const Vec& tone : tones) covariance(a, b) += (tone[a] - mean[a]) * (tone[b] - mean[b]);
      covariance(a, b) =
          covariance(a, b) / static_cast<double>(tones.size()) + kOwnVariance * thickness[a] * thickness[b];
    }
  }
  cv::eigen(covariance, variances, directions);
  Vec direction(directions(0, 0), directions(0, 1), directions(0, 2));
  // An eigenvector's sign is arbitrary.
  if (direction[0] < 0) direction = -direction;
  std::vector<float> along;
  double squares = 0;
  for (const Vec& tone : tones) {
    const double at = (tone - mean).dot(direction);
    along.push_back(static_cast<float>(at));
    squares += at * at;
  }
  std::sort(along.begin(), along.end());
  const auto end = static_cast<size_t>(kEnds * static_cast<double>(along.size() - 1));
  result.least = along[end];
  result.most = along[along.size() - 1 - end];
  result.spread = static_cast<float>(std::sqrt(squares / static_cast<double>(tones.size())));
  for (size_t c = 0; c < 3; ++c) {
    result.mean[c] = static_cast<float>(mean[static_cast<int>(c)]);
    result.direction[c] = static_cast<float>(direction[static_cast<int>(c)]);
  }
  return result;
}

LeafTones measureTones(const LeafStages& example, const std::vector<float>& colours) {
  const LabelField& regions = example.seen.regions;
  const double factor = smallFactor(regions.size);
  const LeafStages small = smallStages(example, factor);
  return measureTones(small.seen.regions, smallColours(colours, regions, small.seen.distance.size), kSmallSide);
}

float boundedShift(const LeafTones& tones, float at, float by) {
  const float beyond = kBeyond * std::abs(by);
  if (beyond <= 0) return 0;
  // What is off the end already has the least room that any place has.
  const float room = std::max(beyond, beyond + (by > 0 ? tones.most - at : at - tones.least));
  return std::copysign(room * (1 - std::exp(-std::abs(by) / room)), by);
}

float TonePhase::at(double x, double y) const {
  const double ux = tip.x() - root.x(), uy = tip.y() - root.y(), length = std::max(1e-6, std::hypot(ux, uy));
  const double dx = (x - root.x()) / length, dy = (y - root.y()) / length;
  const double along = (dx * ux + dy * uy) / length, across = (dy * ux - dx * uy) / length;
  const double half = across / std::hypot(across, kMiddle), end = std::clamp(2 * along - 1, -1.0, 1.0);
  return static_cast<float>(kHalf * half + kEnd * end);
}

float toneAngle(quint64 seed) {
  // The golden ratio's fraction of 2^64, so that no seed is too large to be exact.
  const quint64 turn = seed * 0x9e3779b97f4a7c15ULL;
  return static_cast<float>(2 * std::numbers::pi * static_cast<double>(turn >> 11u) / 9007199254740992.0);
}

void shiftColours(std::vector<float>& lab, const std::array<float, 3>& by) {
  for (size_t i = 0; i < lab.size(); ++i) lab[i] += by[i % 3];
}

}  // namespace windfall::model
