#include "model/leaf/tone_variety.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "kernels/random.h"
#include "model/leaf/classic.h"
#include "model/leaf/guided.h"
#include "model/leaf/joined_examples.h"
#include "model/leaf/region_match.h"
#include "model/leaf/small_leaf.h"
#include "model/leaf/superpixels.h"
#include "model/progress_part.h"

namespace windfall::model {

namespace {

constexpr quint64 kSeeds[] = {101, 202, 303};  ///< of the small variants; no artist's choice hangs on them
constexpr int kStarts = 6;                     ///< angles that tones are tried from
constexpr size_t kPlaces = 400;                ///< of a small leaf that differences are taken at
constexpr float kStrongest = 60;               ///< CIE76
constexpr int kHalvings = 9;
/// Variants of the full size differ less than small ones, and their seeds' own differences scatter.
constexpr double kMargin = 1.12;

/// The finest superpixels have no pixels of their own in a small leaf: it has one level less.
SynthesisParameters smallClassic(SynthesisParameters parameters) {
  parameters.superpixels = std::max(1, parameters.superpixels / (parameters.levels <= 3 ? 8 : 4));
  parameters.levels = std::max(1, parameters.levels - 1);
  parameters.detail = false;
  return parameters;
}

}  // namespace

SmallVariants smallVariants(const LeafStages& target, const LeafStages& example, const std::vector<float>& colours,
                            const SynthesisParameters& parameters, Progress& progress) {
  const double factor = smallFactor(target.grown.distance.size);
  LeafStages to = smallStages(target, factor), from = smallStages(example, factor);
  const std::vector<float> lab = smallColours(colours, example.seen.regions, from.seen.distance.size);
  const SynthesisParameters classic = smallClassic(parameters);
  if (!parameters.guided) {
    to.grown.superpixels = makeSuperpixels(to.grown.distance, to.grown.regions, classic.superpixels);
    from.seen.superpixels = makeSuperpixels(from.seen.distance, from.seen.regions, classic.superpixels);
  }
  std::vector<GuidedLevel> levels;
  if (parameters.guided) {
    const VeinFrame own = findVeinFrame(to.grown, to.toWorking(to.root), to.toWorking(to.tip));
    levels.push_back({std::move(makePatchImages(to.grown, own, nullptr, {1})[0]),
                      std::move(makePatchImages(from.seen, exampleFrame(from), lab.data(), {1})[0])});
  }
  SmallVariants result;
  result.tones = measureTones(from.seen.regions, lab, kSmallSide);
  result.regions = to.grown.regions;
  result.low.resize(std::size(kSeeds));
  ProgressTogether together(progress);
  const auto make = [&](size_t n) {
    ProgressTogether::Work work(together, 1.0 / static_cast<double>(result.low.size()));
    RandomSequence random(kSeeds[n], 211);
    const std::vector<int> match = chooseRegions(to, from, random, !parameters.guided && parameters.asThesis);
    const std::vector<float> made = parameters.guided
                                        ? synthesizeGuided(levels, match, parameters.guideWeight, kSeeds[n], work)
                                        : synthesizeClassic(to, from, lab, match, classic, kSeeds[n], work);
    if (!made.empty()) result.low[n] = withoutDetail(made, result.regions, kSmallSide);
  };
  // A guided one keeps all threads busy by itself.
  if (parameters.guided) {
    for (size_t n = 0; n < result.low.size(); ++n) make(n);
  } else {
#pragma omp parallel for schedule(dynamic, 1)
    for (size_t n = 0; n < result.low.size(); ++n) make(n);
  }
  for (const std::vector<float>& low : result.low) {
    if (low.empty()) return {};
  }
  return result;
}

float toneStrength(const SmallVariants& variants, const TonePhase& phase, double wanted) {
  const LeafTones& tones = variants.tones;
  struct Place {
    size_t at;
    float phase;
  };
  std::vector<Place> places;
  const LabelField& regions = variants.regions;
  for (size_t i = 0; i < regions.values.size(); ++i) {
    if (regions.values[i] <= 0 || regions.values[i] == regions.petiole) continue;
    const auto width = static_cast<size_t>(regions.size.width());
    const size_t y = i / width, x = i - y * width;
    places.push_back({i, phase.at(static_cast<double>(x), static_cast<double>(y))});
  }
  if (places.empty() || variants.low.size() < 2) return 0;
  const size_t step = std::max<size_t>(1, places.size() / kPlaces);
  const auto toned = [&](const std::vector<float>& low, const Place& place, float angle, float strength) {
    cv::Vec3f colour(low[3 * place.at], low[3 * place.at + 1], low[3 * place.at + 2]);
    const cv::Vec3f direction(tones.direction[0], tones.direction[1], tones.direction[2]);
    const cv::Vec3f mean(tones.mean[0], tones.mean[1], tones.mean[2]);
    return cv::Vec3f(colour + direction * boundedShift(tones, (colour - mean).dot(direction),
                                                       strength * std::sin(angle + place.phase)));
  };
  const auto difference = [&](float strength) {
    double sum = 0, count = 0;
    for (size_t a = 0; a < variants.low.size(); ++a) {
      const std::vector<float>&one = variants.low[a], &other = variants.low[(a + 1) % variants.low.size()];
      for (int start = 0; start < kStarts; ++start) {
        const float angle = static_cast<float>(2 * std::numbers::pi * start / kStarts);
        for (size_t i = 0; i < places.size(); i += step) {
          sum += cv::norm(toned(one, places[i], angle, strength) -
                          toned(other, places[i], angle + toneAngle(1), strength));
          ++count;
        }
      }
    }
    return sum / count;
  };
  wanted *= kMargin;
  if (difference(0) >= wanted) return 0;
  float low = 0, high = kStrongest;
  for (int n = 0; n < kHalvings; ++n) {
    const float middle = (low + high) / 2;
    (difference(middle) < wanted ? low : high) = middle;
  }
  return high;
}

void addTone(std::vector<float>& lab, const LabelField& regions, const LeafTones& tones, const TonePhase& phase,
             float strength, quint64 seed) {
  if (strength <= 0) return;
  const double factor = smallFactor(regions.size);
  const int width = regions.size.width(), height = regions.size.height();
  const cv::Size size(std::max(1, static_cast<int>(std::lround(width / factor))),
                      std::max(1, static_cast<int>(std::lround(height / factor))));
  LabelField small{{size.width, size.height}, std::vector<qint32>(static_cast<size_t>(size.area()), 0), 1};
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const int fx = std::min(width - 1, static_cast<int>((x + 0.5) * width / size.width));
      const int fy = std::min(height - 1, static_cast<int>((y + 0.5) * height / size.height));
      const qint32 region =
          regions.values[static_cast<size_t>(fy) * static_cast<size_t>(width) + static_cast<size_t>(fx)];
      const bool blade = region > 0 && region != regions.petiole;
      small.values[static_cast<size_t>(y) * static_cast<size_t>(size.width) + static_cast<size_t>(x)] = blade ? 1 : 0;
    }
  }
  const std::vector<float> low = withoutDetail(smallColours(lab, regions, small.size), small, kSmallSide);
  cv::Mat1f shift(size), full;
  const float angle = toneAngle(seed);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const size_t i = static_cast<size_t>(y) * static_cast<size_t>(size.width) + static_cast<size_t>(x);
      float at = 0;
      // Off the blade, along the petiole, the tone is that of its middle.
      if (low[3 * i] > 0) {
        for (size_t c = 0; c < 3; ++c) at += (low[3 * i + c] - tones.mean[c]) * tones.direction[c];
      }
      const float by =
          strength * std::sin(angle + phase.at((x + 0.5) * width / size.width, (y + 0.5) * height / size.height));
      shift(y, x) = boundedShift(tones, at, by);
    }
  }
  cv::resize(shift, full, {width, height}, 0, 0, cv::INTER_LINEAR);
  auto by = full.begin();
  for (size_t i = 0; i < regions.values.size(); ++i, ++by) {
    if (regions.values[i] <= 0) continue;
    for (size_t c = 0; c < 3; ++c) lab[3 * i + c] += *by * tones.direction[c];
  }
}

}  // namespace windfall::model
