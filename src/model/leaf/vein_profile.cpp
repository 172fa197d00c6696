#include "model/leaf/vein_profile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace windfall::model {

namespace {

constexpr double kBlur = 8;                  // px at 512: what is wider is no vein
constexpr float kReach = 20, kStep = 1.25f;  // px at 512: how far beside a vein, and of one bin
constexpr int kBins = static_cast<int>(kReach / kStep);
constexpr std::array<float, 3> kStanding{0.08f, 0.3f, 0.7f};  ///< of the classes of veins, from fine to main
constexpr size_t kFew = 60;                                   ///< pixels of a bin that tell nothing

using Profile = std::array<cv::Vec3f, kBins>;
using Profiles = std::array<Profile, kStanding.size()>;

struct Measured {
  Profiles profiles{};
  std::array<std::array<bool, kBins>, kStanding.size()> known{};
};

/// Pixels of a leaf that one of 512 px stands for.
float unitOf(const VeinedLeaf& leaf) { return static_cast<float>(leaf.frame.longSide) / 512; }

/// Which two classes a standing lies between, and how near to the second.
std::pair<size_t, float> between(float standing) {
  size_t low = 0;
  while (low + 2 < kStanding.size() && standing > kStanding[low + 1]) ++low;
  return {low, std::clamp((standing - kStanding[low]) / (kStanding[low + 1] - kStanding[low]), 0.f, 1.f)};
}

/// Colours without their low-pass over the blade; 0 off it.
cv::Mat3f withoutLowPass(const VeinedLeaf& leaf, cv::Mat1b& blade) {
  const LeafStructure& structure = leaf.structure;
  const int width = structure.distance.size.width(), height = structure.distance.size.height();
  blade.create(height, width);
  for (size_t i = 0; i < structure.regions.values.size(); ++i) {
    const qint32 region = structure.regions.values[i];
    blade.data[i] = region > 0 && region != structure.regions.petiole ? 255 : 0;
  }
  const cv::Mat3f lab(height, width, reinterpret_cast<cv::Vec3f*>(const_cast<float*>(leaf.lab.data())));
  cv::Mat3f masked(height, width, cv::Vec3f(0, 0, 0)), sum;
  lab.copyTo(masked, blade);
  cv::Mat1f weight;
  blade.convertTo(weight, CV_32F, 1 / 255.0);
  // So wide a blur is as good and quick on a smaller picture.
  const double sigma = kBlur * static_cast<double>(unitOf(leaf)), step = std::max(1.0, sigma / 4);
  const cv::Size small(std::max(1, static_cast<int>(width / step)), std::max(1, static_cast<int>(height / step)));
  cv::resize(masked, sum, small, 0, 0, cv::INTER_AREA);
  cv::resize(weight, weight, small, 0, 0, cv::INTER_AREA);
  cv::GaussianBlur(sum, sum, {}, sigma / step, sigma / step, cv::BORDER_CONSTANT);
  cv::GaussianBlur(weight, weight, {}, sigma / step, sigma / step, cv::BORDER_CONSTANT);
  for (int y = 0; y < small.height; ++y) {
    for (int x = 0; x < small.width; ++x) sum(y, x) /= std::max(1e-4f, weight(y, x));
  }
  cv::Mat3f low;
  cv::resize(sum, low, {width, height}, 0, 0, cv::INTER_LINEAR);
  cv::Mat3f rest(height, width, cv::Vec3f(0, 0, 0));
  cv::subtract(lab, low, rest, blade);
  return rest;
}

Measured measure(const VeinedLeaf& leaf) {
  cv::Mat1b blade;
  const cv::Mat3f rest = withoutLowPass(leaf, blade);
  const float unit = unitOf(leaf);
  std::array<std::array<std::array<std::vector<float>, 3>, kBins>, kStanding.size()> values;
  auto colour = rest.begin();
  for (size_t i = 0; i < blade.total(); ++i, ++colour) {
    if (!blade.data[i]) continue;
    const float reach = std::max(0.f, leaf.frame.reach[i]) / unit;
    if (reach >= kReach) continue;
    const auto [low, share] = between(leaf.frame.standing[i]);
    auto& bin = values[low + (share > 0.5f ? 1 : 0)][static_cast<size_t>(reach / kStep)];
    for (int c = 0; c < 3; ++c) bin[static_cast<size_t>(c)].push_back((*colour)[c]);
  }
  Measured result;
  for (size_t k = 0; k < kStanding.size(); ++k) {
    for (size_t b = 0; b < kBins; ++b) {
      result.known[k][b] = values[k][b][0].size() >= kFew * static_cast<size_t>(std::max(1.f, unit * unit));
      for (size_t c = 0; c < 3 && !values[k][b][c].empty(); ++c) {
        std::vector<float>& list = values[k][b][c];
        const auto middle = list.begin() + static_cast<std::ptrdiff_t>(list.size() / 2);
        std::nth_element(list.begin(), middle, list.end());
        result.profiles[k][b][static_cast<int>(c)] = *middle;
      }
    }
  }
  return result;
}

}  // namespace

std::vector<float> restoreVeins(const VeinedLeaf& made, const VeinedLeaf& example) {
  Measured both[2];
#pragma omp parallel for schedule(static, 1)
  for (int leaf = 0; leaf < 2; ++leaf) both[leaf] = measure(leaf == 0 ? made : example);
  const Measured &has = both[0], &wanted = both[1];
  Profiles lacks{};
  for (size_t k = 0; k < kStanding.size(); ++k) {
    for (size_t b = 0; b < kBins; ++b) {
      if (!has.known[k][b] || !wanted.known[k][b]) continue;
      const float fade = std::min(1.f, 4 * (1 - (static_cast<float>(b) + 0.5f) / kBins));
      lacks[k][b] = fade * (wanted.profiles[k][b] - has.profiles[k][b]);
    }
  }
  std::vector<float> result = made.lab;
  const QSize size = made.structure.distance.size;
  const float unit = static_cast<float>(std::max(size.width(), size.height())) / 512;
  for (size_t i = 0; i < made.structure.regions.values.size(); ++i) {
    const qint32 region = made.structure.regions.values[i];
    if (region <= 0 || region == made.structure.regions.petiole) continue;
    const float place = std::max(0.f, made.frame.reach[i]) / unit / kStep - 0.5f;
    if (place >= kBins - 1) continue;
    const auto bin = static_cast<size_t>(std::max(0.f, std::floor(place)));
    const float along = std::clamp(place - static_cast<float>(bin), 0.f, 1.f);
    const auto [low, share] = between(made.frame.standing[i]);
    const cv::Vec3f fine = lacks[low][bin] * (1 - along) + lacks[low][bin + 1] * along;
    const cv::Vec3f main = lacks[low + 1][bin] * (1 - along) + lacks[low + 1][bin + 1] * along;
    const cv::Vec3f add = fine * (1 - share) + main * share;
    for (int c = 0; c < 3; ++c) result[3 * i + static_cast<size_t>(c)] += add[c];
  }
  return result;
}

}  // namespace windfall::model
