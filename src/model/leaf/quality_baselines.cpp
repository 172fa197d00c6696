#include "model/leaf/quality_baselines.h"

#include <algorithm>

#include "kernels/random.h"
#include "model/leaf/classic.h"

namespace windfall::model {

namespace {

std::vector<size_t> leafPixels(const LeafStructure& structure) {
  std::vector<size_t> pixels;
  for (size_t i = 0; i < structure.regions.values.size(); ++i) {
    if (structure.regions.values[i] > 0) pixels.push_back(i);
  }
  return pixels;
}

void copyPixel(std::vector<float>& to, size_t t, const std::vector<float>& from, size_t e) {
  for (size_t c = 0; c < 3; ++c) to[3 * t + c] = from[3 * e + c];
}

std::vector<float> oneMean(const BaselineInput& in) {
  std::array<double, 3> sum{};
  const std::vector<size_t> source = leafPixels(in.example.seen);
  for (const size_t e : source) {
    for (size_t c = 0; c < 3; ++c) sum[c] += in.colours[3 * e + c];
  }
  std::vector<float> result(3 * in.target.grown.distance.values.size());
  for (size_t i = 0; i < result.size(); ++i) {
    result[i] = static_cast<float>(sum[i % 3] / std::max<double>(1, static_cast<double>(source.size())));
  }
  return result;
}

std::vector<float> regionMeans(const BaselineInput& in) {
  std::vector<std::array<double, 4>> sums(static_cast<size_t>(in.example.seen.regions.count) + 1);
  for (const size_t e : leafPixels(in.example.seen)) {
    std::array<double, 4>& sum = sums[static_cast<size_t>(in.example.seen.regions.values[e])];
    for (size_t c = 0; c < 3; ++c) sum[c] += in.colours[3 * e + c];
    sum[3] += 1;
  }
  std::vector<float> result(3 * in.target.grown.distance.values.size(), 0.f);
  for (const size_t t : leafPixels(in.target.grown)) {
    const auto region = static_cast<size_t>(in.target.grown.regions.values[t] - 1);
    const std::array<double, 4>& sum = sums[static_cast<size_t>(region < in.match.size() ? in.match[region] : 1)];
    for (size_t c = 0; c < 3; ++c) result[3 * t + c] = static_cast<float>(sum[c] / std::max(1.0, sum[3]));
  }
  return result;
}

/// The coarsest level of the thesis's pyramid, painted as it is.
std::vector<float> fewSuperpixels(const BaselineInput& in) {
  constexpr int kCount = 64;
  LeafStages target, example;
  target.grown = in.target.grown, example.seen = in.example.seen;
  target.grown.superpixels = makeSuperpixels(target.grown.distance, target.grown.regions, kCount);
  example.seen.superpixels = makeSuperpixels(example.seen.distance, example.seen.regions, kCount);
  SynthesisParameters parameters;
  parameters.levels = 1;
  const std::vector<SuperpixelMean> chosen =
      chooseSuperpixels(target, example, in.colours, in.match, parameters, in.seed);
  std::vector<float> result(3 * target.grown.distance.values.size(), 0.f);
  for (size_t i = 0; i < target.grown.superpixels.values.size(); ++i) {
    const qint32 label = target.grown.superpixels.values[i];
    if (label <= 0 || static_cast<size_t>(label) > chosen.size()) continue;
    for (size_t c = 0; c < 3; ++c) result[3 * i + c] = chosen[static_cast<size_t>(label - 1)].lab[c];
  }
  return result;
}

std::vector<float> randomPixels(const BaselineInput& in) {
  const std::vector<size_t> source = leafPixels(in.example.seen);
  RandomSequence random(in.seed, 331);
  std::vector<float> result(3 * in.target.grown.distance.values.size(), 0.f);
  for (const size_t t : leafPixels(in.target.grown)) {
    copyPixel(result, t, in.colours, source[random.below(static_cast<std::uint32_t>(source.size()))]);
  }
  return result;
}

std::vector<float> randomPatches(const BaselineInput& in) {
  constexpr int kSide = 32;
  const QSize to = in.target.grown.distance.size, from = in.example.seen.distance.size;
  const auto inside = [&](int x, int y) {
    return in.example.seen.regions
               .values[static_cast<size_t>(y) * static_cast<size_t>(from.width()) + static_cast<size_t>(x)] > 0;
  };
  RandomSequence random(in.seed, 337);
  std::vector<float> result(3 * in.target.grown.distance.values.size(), 0.f);
  for (int top = 0; top < to.height(); top += kSide) {
    for (int left = 0; left < to.width(); left += kSide) {
      int x = 0, y = 0;
      for (int attempt = 0; attempt < 400; ++attempt) {
        x = static_cast<int>(random.below(static_cast<std::uint32_t>(std::max(1, from.width() - kSide))));
        y = static_cast<int>(random.below(static_cast<std::uint32_t>(std::max(1, from.height() - kSide))));
        if (inside(x, y) && inside(x + kSide - 1, y) && inside(x, y + kSide - 1) &&
            inside(x + kSide - 1, y + kSide - 1))
          break;
      }
      for (int j = 0; j < kSide && top + j < to.height(); ++j) {
        for (int i = 0; i < kSide && left + i < to.width(); ++i) {
          copyPixel(result,
                    static_cast<size_t>(top + j) * static_cast<size_t>(to.width()) + static_cast<size_t>(left + i),
                    in.colours,
                    static_cast<size_t>(std::min(y + j, from.height() - 1)) * static_cast<size_t>(from.width()) +
                        static_cast<size_t>(std::min(x + i, from.width() - 1)));
        }
      }
    }
  }
  return result;
}

std::vector<float> rowStretch(const BaselineInput& in) {
  return stretchRows(in.target.grown, workingAxis(in.target), {&in.example.seen, in.colours}, workingAxis(in.example));
}

}  // namespace

std::vector<Baseline> naiveBaselines() {
  return {{"naive: one mean colour", oneMean},
          {"naive: mean colour of regions", regionMeans},
          {"naive: 64 superpixels", fewSuperpixels},
          {"naive: random pixels", randomPixels},
          {"naive: random patches, 32 px", randomPatches},
          {"naive: photo stretched by rows", rowStretch}};
}

std::array<QPointF, 2> workingAxis(const LeafStages& stages) {
  return {stages.toWorking(stages.root), stages.toWorking(stages.tip)};
}

}  // namespace windfall::model
