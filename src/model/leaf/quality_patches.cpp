#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "kernels/random.h"
#include "model/leaf/quality_private.h"

namespace windfall::model {

namespace {

constexpr int kSide = 7, kRadius = kSide / 2, kComponents = 24;
constexpr int kNumbers = 3 * kSide * kSide;

using Lanes = float __attribute__((vector_size(16)));

struct Halved {
  cv::Mat3f lab;
  cv::Mat1b leaf;
};

/// Each scale half of the one before; colours are means over the leaf alone.
std::vector<Halved> pyramidOf(const MeasuredLeaf& leaf) {
  std::vector<Halved> scales;
  const cv::Size full(static_cast<int>(std::lround(leaf.leaf.cols / leaf.unit)),
                      static_cast<int>(std::lround(leaf.leaf.rows / leaf.unit)));
  cv::Mat1f inside;
  leaf.leaf.convertTo(inside, CV_32F, 1 / 255.0);
  cv::Mat3f masked = leaf.lab.clone();
  masked.setTo(cv::Scalar::all(0), ~leaf.leaf);
  for (int n = 0; n < PatchSamples::kScales; ++n) {
    const cv::Size size(std::max(1, full.width >> n), std::max(1, full.height >> n));
    Halved scale;
    cv::Mat1f weight;
    cv::resize(inside, weight, size, 0, 0, cv::INTER_AREA);
    cv::resize(masked, scale.lab, size, 0, 0, cv::INTER_AREA);
    for (int y = 0; y < size.height; ++y) {
      for (int x = 0; x < size.width; ++x) scale.lab(y, x) /= std::max(1e-4f, weight(y, x));
    }
    scale.leaf = weight > 0.99f;
    scales.push_back(std::move(scale));
  }
  return scales;
}

/// Two disjoint samples of the patches that lie on the leaf altogether. The order depends on nothing but the places, so
/// that equal pictures give equal samples.
std::array<cv::Mat1f, 2> drawPatches(const Halved& scale, int number) {
  cv::Mat1b whole;
  cv::erode(scale.leaf, whole, cv::Mat(kSide, kSide, CV_8U, cv::Scalar(1)), {-1, -1}, 1, cv::BORDER_CONSTANT, 0);
  std::vector<cv::Point> places;
  cv::findNonZero(whole, places);
  RandomSequence random(17, static_cast<std::uint32_t>(number));
  for (size_t i = places.size(); i > 1; --i)
    std::swap(places[i - 1], places[random.below(static_cast<std::uint32_t>(i))]);
  const size_t count = std::min<size_t>(PatchSamples::kWanted, places.size() / 2);
  std::array<cv::Mat1f, 2> samples;
  for (size_t half = 0; half < 2; ++half) {
    samples[half].create(static_cast<int>(count), kNumbers);
    for (size_t i = 0; i < count; ++i) {
      const cv::Point at = places[half * count + i];
      float* row = samples[half][static_cast<int>(i)];
      for (int dy = -kRadius; dy <= kRadius; ++dy) {
        const cv::Vec3f* from = &scale.lab(at.y + dy, at.x - kRadius);
        for (int k = 0; k < kSide; ++k) {
          for (int c = 0; c < 3; ++c) *row++ = from[k][c];
        }
      }
    }
  }
  return samples;
}

/// Euclidean distance of each row of `asked` to the nearest row of `known`.
std::vector<float> nearest(const cv::Mat1f& asked, const cv::Mat1f& known) {
  std::vector<float> result(static_cast<size_t>(asked.rows), 0.f);
#pragma omp parallel for schedule(static)
  for (int i = 0; i < asked.rows; ++i) {
    Lanes wanted[kComponents / 4];
    std::memcpy(wanted, asked[i], sizeof wanted);
    float best = 1e30f;
    for (int j = 0; j < known.rows; ++j) {
      const float* other = known[j];
      float sum = 0;
      // Components come by falling variance: most rows are out after the first eight.
      for (int block = 0; block < kComponents / 8 && sum < best; ++block) {
        Lanes a, b;
        std::memcpy(&a, other + 8 * block, sizeof a);
        std::memcpy(&b, other + 8 * block + 4, sizeof b);
        a -= wanted[2 * block], b -= wanted[2 * block + 1];
        const Lanes squares = a * a + b * b;
        sum += (squares[0] + squares[1]) + (squares[2] + squares[3]);
      }
      best = std::min(best, sum);
    }
    result[static_cast<size_t>(i)] = std::sqrt(best);
  }
  return result;
}

cv::Mat1f reduced(const cv::Mat1f& patches, const cv::Mat1f& basis, const cv::Mat1f& mean) {
  cv::Mat1f centred(patches.size());
  for (int i = 0; i < patches.rows; ++i) cv::subtract(patches.row(i), mean, centred.row(i));
  return centred * basis.t();
}

double percentile95(std::vector<float> values) {
  if (values.empty()) return 0;
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

double meanOf(const std::vector<float>& values) {
  double sum = 0;
  for (const float value : values) sum += value;
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

constexpr double kLeast = 0.05;  ///< below this two patches look the same

}  // namespace

PatchSamples::PatchSamples(const MeasuredLeaf& example) {
  const std::vector<Halved> pyramid = pyramidOf(example);
  for (int n = 0; n < kScales; ++n) {
    const std::array<cv::Mat1f, 2> samples = drawPatches(pyramid[static_cast<size_t>(n)], n);
    if (samples[0].rows < 2 * kComponents) break;
    Scale scale;
    const cv::PCA pca(samples[0], cv::noArray(), cv::PCA::DATA_AS_ROW, kComponents);
    scale.basis = pca.eigenvectors;
    scale.mean = pca.mean;
    scale.known = reduced(samples[0], scale.basis, scale.mean);
    scale.asked = reduced(samples[1], scale.basis, scale.mean);
    const std::vector<float> within = nearest(scale.asked, scale.known);
    scale.within95 = percentile95(within);
    scale.withinMean = meanOf(within);
    scales_.push_back(std::move(scale));
  }
}

PatchSamples::Ratios PatchSamples::compare(const MeasuredLeaf& made) const {
  const std::vector<Halved> pyramid = pyramidOf(made);
  double coherence = 0, completeness = 0;
  int counted = 0;
  for (size_t n = 0; n < scales_.size(); ++n) {
    const Scale& scale = scales_[n];
    const std::array<cv::Mat1f, 2> samples = drawPatches(pyramid[n], static_cast<int>(n));
    if (samples[0].rows == 0) continue;
    const std::vector<float> toExample = nearest(reduced(samples[1], scale.basis, scale.mean), scale.known);
    const std::vector<float> toMade = nearest(scale.asked, reduced(samples[0], scale.basis, scale.mean));
    coherence += std::log((percentile95(toExample) + kLeast) / (scale.within95 + kLeast));
    completeness += std::log((meanOf(toMade) + kLeast) / (scale.withinMean + kLeast));
    ++counted;
  }
  if (counted == 0) return {};
  return {std::exp(coherence / counted), std::exp(completeness / counted)};
}

}  // namespace windfall::model
