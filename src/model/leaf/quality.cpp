#include "model/leaf/quality.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "kernels/random.h"
#include "model/leaf/quality_private.h"

namespace windfall::model {

namespace {

constexpr int kDistanceBins = 12, kQuantiles = 64;
constexpr int kBands = 5;
constexpr int kVeinBins = 7;
constexpr double kVeinReach = 18, kVeinBlur = 8;  // px at 512
constexpr double kLeastVeins = 0.02;
constexpr double kCopyBlur = 8;  // px at 512
constexpr int kCeilingPairs = 20000;

using Profile = std::array<cv::Vec3f, kVeinBins>;

/// Colours of the leaf by bins of the structural distance that hold as many of the example's pixels each.
struct ColourBins {
  std::array<std::array<std::vector<float>, 3>, kDistanceBins> quantile;
  std::array<double, kDistanceBins> share{};
};

std::vector<float> binEdges(const MeasuredLeaf& example) {
  std::vector<float> values;
  for (int y = 0; y < example.leaf.rows; ++y) {
    for (int x = 0; x < example.leaf.cols; ++x) {
      if (example.leaf(y, x)) values.push_back(example.distance(y, x));
    }
  }
  std::sort(values.begin(), values.end());
  std::vector<float> edges;
  for (size_t i = 1; i < kDistanceBins && !values.empty(); ++i)
    edges.push_back(values[i * values.size() / kDistanceBins]);
  return edges;
}

ColourBins binColours(const MeasuredLeaf& leaf, const std::vector<float>& edges) {
  std::array<std::array<std::vector<float>, 3>, kDistanceBins> values;
  double count = 0;
  for (int y = 0; y < leaf.leaf.rows; ++y) {
    for (int x = 0; x < leaf.leaf.cols; ++x) {
      if (!leaf.leaf(y, x)) continue;
      const auto bin =
          static_cast<size_t>(std::upper_bound(edges.begin(), edges.end(), leaf.distance(y, x)) - edges.begin());
      for (int c = 0; c < 3; ++c) values[bin][static_cast<size_t>(c)].push_back(leaf.lab(y, x)[c]);
      ++count;
    }
  }
  ColourBins bins;
  for (size_t bin = 0; bin < kDistanceBins; ++bin) {
    bins.share[bin] = static_cast<double>(values[bin][0].size()) / std::max(1.0, count);
    for (size_t c = 0; c < 3; ++c) bins.quantile[bin][c] = quantiles(std::move(values[bin][c]), kQuantiles);
  }
  return bins;
}

double colourDifference(const ColourBins& made, const ColourBins& example) {
  double sum = 0, shares = 0;
  for (size_t bin = 0; bin < kDistanceBins; ++bin) {
    if (made.quantile[bin][0].empty() || example.quantile[bin][0].empty()) continue;
    double squares = 0;
    for (size_t c = 0; c < 3; ++c) {
      const double d = wasserstein(made.quantile[bin][c], example.quantile[bin][c]);
      squares += d * d;
    }
    sum += made.share[bin] * std::sqrt(squares);
    shares += made.share[bin];
  }
  return shares > 0 ? sum / shares : 100;
}

/// Standard deviation of each octave of the lightness, and how steep it is.
struct Octaves {
  std::array<double, kBands> deviation{};
  std::array<std::vector<float>, kBands> steepness;
};

cv::Mat1f divided(const cv::Mat1f& sum, const cv::Mat1f& weight) { return sum / cv::max(weight, 1e-4f); }

Octaves measureOctaves(const MeasuredLeaf& leaf) {
  cv::Mat1f lightness, weight;
  cv::extractChannel(leaf.lab, lightness, 0);
  leaf.leaf.convertTo(weight, CV_32F, 1 / 255.0);
  if (leaf.unit != 1) {
    const cv::Size size(static_cast<int>(std::lround(weight.cols / leaf.unit)),
                        static_cast<int>(std::lround(weight.rows / leaf.unit)));
    cv::Mat1f smaller;
    cv::resize(lightness.mul(weight), lightness, size, 0, 0, cv::INTER_AREA);
    cv::resize(weight, smaller, size, 0, 0, cv::INTER_AREA);
    lightness = divided(lightness, smaller);
    weight = smaller;
  }
  Octaves octaves;
  cv::Mat1f sum = lightness.mul(weight);
  for (size_t band = 0; band < kBands; ++band) {
    cv::Mat1f coarse, coarseWeight, back, backWeight;
    cv::pyrDown(sum, coarse);
    cv::pyrDown(weight, coarseWeight);
    cv::pyrUp(coarse, back, sum.size());
    cv::pyrUp(coarseWeight, backWeight, sum.size());
    const cv::Mat1f level = divided(sum, weight), low = divided(back, backWeight);
    double count = 0, first = 0, second = 0;
    std::vector<float> steep;
    for (int y = 0; y < level.rows; ++y) {
      for (int x = 0; x < level.cols; ++x) {
        if (weight(y, x) < 0.5f) continue;
        const double v = level(y, x) - low(y, x);
        ++count, first += v, second += v * v;
        if (x + 1 >= level.cols || y + 1 >= level.rows || x == 0 || y == 0) continue;
        if (weight(y, x + 1) < 0.5f || weight(y, x - 1) < 0.5f || weight(y + 1, x) < 0.5f || weight(y - 1, x) < 0.5f)
          continue;
        const float dx = 0.5f * (level(y, x + 1) - level(y, x - 1)), dy = 0.5f * (level(y + 1, x) - level(y - 1, x));
        steep.push_back(std::log(std::hypot(dx, dy) + 0.05f));
      }
    }
    if (count > 0) octaves.deviation[band] = std::sqrt(std::max(0.0, second / count - first * first / count / count));
    octaves.steepness[band] = quantiles(std::move(steep), kQuantiles);
    sum = coarse, weight = coarseWeight;
  }
  return octaves;
}

/// Medians of what is left of the colours without their low-pass, by distance to the nearest vein, without their mean.
Profile veinProfile(const MeasuredLeaf& leaf) {
  const cv::Mat3f low = maskedBlur(leaf.lab, leaf.leaf, kVeinBlur * leaf.unit);
  std::array<std::array<std::vector<float>, 3>, kVeinBins> values;
  for (int y = 0; y < leaf.leaf.rows; ++y) {
    for (int x = 0; x < leaf.leaf.cols; ++x) {
      if (!leaf.leaf(y, x) || leaf.toVein(y, x) >= kVeinReach) continue;
      const auto bin = static_cast<size_t>(leaf.toVein(y, x) * kVeinBins / kVeinReach);
      for (int c = 0; c < 3; ++c) values[bin][static_cast<size_t>(c)].push_back(leaf.lab(y, x)[c] - low(y, x)[c]);
    }
  }
  Profile profile{};
  cv::Vec3f mean(0, 0, 0);
  for (size_t bin = 0; bin < kVeinBins; ++bin) {
    for (int c = 0; c < 3; ++c) {
      std::vector<float>& list = values[bin][static_cast<size_t>(c)];
      if (list.empty()) continue;
      const auto middle = list.begin() + static_cast<std::ptrdiff_t>(list.size() / 2);
      std::nth_element(list.begin(), middle, list.end());
      profile[bin][c] = *middle;
    }
    mean += profile[bin] * (1.f / kVeinBins);
  }
  for (cv::Vec3f& value : profile) value -= mean;
  return profile;
}

double norm(const Profile& profile) {
  double sum = 0;
  for (const cv::Vec3f& value : profile) sum += value.dot(value);
  return std::sqrt(sum);
}

cv::Mat3f lowPass(const ScoredLeaf& leaf, const std::vector<float>& lab) {
  ScoredLeaf of{leaf.structure, lab};
  const MeasuredLeaf measured = measureLeaf(of);
  return maskedBlur(measured.lab, measured.leaf, kCopyBlur * measured.unit);
}

}  // namespace

double QualityTerms::score() const { return 100 * std::pow(colour * texture * patches * veins, 0.25); }

struct QualityReference::Known {
  explicit Known(const MeasuredLeaf& example)
      : edges(binEdges(example)),
        colours(binColours(example, edges)),
        octaves(measureOctaves(example)),
        patches(example),
        profile(veinProfile(example)) {}
  std::vector<float> edges;
  ColourBins colours;
  Octaves octaves;
  PatchSamples patches;
  Profile profile;
};

QualityReference::QualityReference(const ScoredLeaf& example)
    : known_(std::make_unique<const Known>(measureLeaf(example))) {}
QualityReference::~QualityReference() = default;
QualityReference::QualityReference(QualityReference&&) noexcept = default;

QualityTerms QualityReference::score(const ScoredLeaf& made) const {
  const MeasuredLeaf leaf = measureLeaf(made);
  QualityTerms terms;
  terms.difference = colourDifference(binColours(leaf, known_->edges), known_->colours);
  terms.colour = std::exp(-terms.difference / 10);
  const Octaves octaves = measureOctaves(leaf);
  for (size_t band = 0; band < kBands; ++band) {
    terms.bands +=
        std::abs(std::log((octaves.deviation[band] + 0.02) / (known_->octaves.deviation[band] + 0.02))) / kBands;
    terms.gradients += wasserstein(octaves.steepness[band], known_->octaves.steepness[band]) / kBands;
  }
  terms.texture = std::exp(-(terms.bands + terms.gradients));
  const PatchSamples::Ratios ratios = known_->patches.compare(leaf);
  terms.coherence = ratios.coherence;
  terms.completeness = ratios.completeness;
  terms.patches = std::exp(-std::max(0.0, std::log(terms.coherence)) / 0.25) *
                  std::exp(-std::max(0.0, std::log(terms.completeness)));
  Profile profile = veinProfile(leaf);
  for (size_t bin = 0; bin < kVeinBins; ++bin) profile[bin] -= known_->profile[bin];
  terms.veins = std::max(kLeastVeins, 1 - norm(profile) / std::max(1e-3, norm(known_->profile)));
  return terms;
}

double copyIndex(const ScoredLeaf& made, const std::vector<float>& stretched) {
  const MeasuredLeaf shape = measureLeaf(made);
  const cv::Mat3f a = lowPass(made, made.lab), b = lowPass(made, stretched);
  const cv::Scalar meanA = cv::mean(a, shape.leaf), meanB = cv::mean(b, shape.leaf);
  double ab = 0, aa = 0, bb = 0;
  for (int y = 0; y < a.rows; ++y) {
    for (int x = 0; x < a.cols; ++x) {
      if (!shape.leaf(y, x)) continue;
      for (int c = 0; c < 3; ++c) {
        const double u = a(y, x)[c] - meanA[c], v = b(y, x)[c] - meanB[c];
        ab += u * v, aa += u * u, bb += v * v;
      }
    }
  }
  return aa > 0 && bb > 0 ? ab / std::sqrt(aa * bb) : 0;
}

double diversity(const ScoredLeaf& made, const std::vector<float>& other) {
  const MeasuredLeaf shape = measureLeaf(made);
  const cv::Mat3f a = lowPass(made, made.lab), b = lowPass(made, other);
  double sum = 0, count = 0;
  for (int y = 0; y < a.rows; ++y) {
    for (int x = 0; x < a.cols; ++x) {
      if (shape.leaf(y, x)) sum += cv::norm(a(y, x) - b(y, x)), ++count;
    }
  }
  return count > 0 ? sum / count : 0;
}

double diversityCeiling(const ScoredLeaf& example) {
  const MeasuredLeaf shape = measureLeaf(example);
  const cv::Mat3f low = lowPass(example, example.lab);
  std::vector<cv::Point> places;
  cv::findNonZero(shape.leaf, places);
  if (places.empty()) return 0;
  RandomSequence random(23);
  const auto any = [&] { return low(places[random.below(static_cast<std::uint32_t>(places.size()))]); };
  double sum = 0;
  for (int i = 0; i < kCeilingPairs; ++i) {
    const cv::Vec3f a = any(), b = any();
    sum += cv::norm(a - b);
  }
  return sum / kCeilingPairs;
}

}  // namespace windfall::model
