#include "model/leaf/classic.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kernels/random.h"
#include "model/leaf/detail.h"
#include "model/leaf/smoothing.h"
#include "model/leaf/superpixel_pyramid.h"

namespace windfall::model {

namespace {

/// A colour a superpixel, painted and smoothed.
std::vector<float> smoothLayer(const LeafStructure& structure, const std::vector<SuperpixelMean>& colours, double w1) {
  const size_t pixels = structure.superpixels.values.size();
  std::vector<float> layer(3 * pixels, 0.f);
  std::vector<unsigned char> mask(pixels, 0);
  for (size_t i = 0; i < pixels; ++i) {
    const qint32 label = structure.superpixels.values[i];
    if (label <= 0) continue;
    mask[i] = 1;
    for (size_t c = 0; c < 3; ++c) layer[3 * i + c] = colours[static_cast<size_t>(label - 1)].lab[c];
  }
  // The kernel reaches sqrt(w1) pixels: the same look at another resolution needs its square.
  const double unit = std::max(structure.distance.size.width(), structure.distance.size.height()) / 512.0;
  const double weight = w1 * unit * unit;
  smooth(layer, mask, structure.distance.size, weight, sweepsFor(weight));
  return layer;
}

/// The example's superpixels of one level by region; entry 0 holds all of them.
std::vector<std::vector<int>> membersOf(const std::vector<SuperpixelPlace>& level) {
  std::vector<std::vector<int>> members(1);
  for (size_t k = 0; k < level.size(); ++k) {
    const auto region = static_cast<size_t>(std::max(0, level[k].mean.region));
    if (region >= members.size()) members.resize(region + 1);
    members[0].push_back(static_cast<int>(k));
    if (region > 0) members[region].push_back(static_cast<int>(k));
  }
  return members;
}

/// From where to where the distances of a region reach: structural, to the veins.
struct Span {
  std::array<float, 2> low{1e9f, 1e9f}, high{-1e9f, -1e9f};
  void add(const SuperpixelMean& mean) {
    const std::array<float, 2> values{mean.distance, mean.veinDistance};
    for (size_t c = 0; c < 2; ++c) low[c] = std::min(low[c], values[c]), high[c] = std::max(high[c], values[c]);
  }
  float share(size_t c, float value) const {
    return high[c] > low[c] ? std::clamp((value - low[c]) / (high[c] - low[c]), 0.f, 1.f) : 0.5f;
  }
  float at(size_t c, float share) const { return low[c] + share * (high[c] - low[c]); }
};

/// By region; entry 0 is the whole leaf's.
std::vector<Span> spansOf(const std::vector<SuperpixelPlace>& level) {
  std::vector<Span> spans(1);
  for (const SuperpixelPlace& p : level) {
    const auto region = static_cast<size_t>(std::max(0, p.mean.region));
    if (region >= spans.size()) spans.resize(region + 1);
    spans[0].add(p.mean);
    if (region > 0) spans[region].add(p.mean);
  }
  return spans;
}

float squareDistance(const float* a, const float* b) {
  float sum = 0;
  for (int c = 0; c < 3; ++c) sum += (a[c] - b[c]) * (a[c] - b[c]);
  return sum;
}

}  // namespace

std::vector<SuperpixelMean> chooseSuperpixels(const LeafStages& target, const LeafStages& example,
                                              const std::vector<float>& colours, const std::vector<int>& match,
                                              const SynthesisParameters& parameters, quint64 seed) {
  SuperpixelPyramid to, from;
#pragma omp parallel for schedule(static, 1)
  for (int leaf = 0; leaf < 2; ++leaf) {
    if (leaf == 0) to = buildSuperpixelPyramid(target.grown, nullptr, parameters.levels);
    if (leaf == 1) from = buildSuperpixelPyramid(example.seen, colours.data(), parameters.levels);
  }
  if (to.back().empty() || from.back().empty()) return {};
  const size_t levels = std::min(to.size(), from.size());
  for (size_t n = 0; n < levels; ++n) {
    // Counted from the finest: a tiny leaf may have fewer levels than the other.
    std::vector<SuperpixelPlace>& level = to[to.size() - levels + n];
    const std::vector<SuperpixelPlace>& source = from[from.size() - levels + n];
    const std::vector<SuperpixelPlace>* coarser = n > 0 ? &to[to.size() - levels + n - 1] : nullptr;
    const std::vector<std::vector<int>> members = membersOf(source);
    const std::vector<Span> toSpans = spansOf(level), fromSpans = spansOf(source);
#pragma omp parallel
    {
      std::vector<std::pair<float, int>> nearest;
#pragma omp for schedule(dynamic, 64)
      for (size_t k = 0; k < level.size(); ++k) {
        SuperpixelMean& mean = level[k].mean;
        const auto region = static_cast<size_t>(mean.region > 0 && mean.region <= static_cast<int>(match.size())
                                                    ? match[static_cast<size_t>(mean.region - 1)]
                                                    : 0);
        const std::vector<int>& pool =
            region < members.size() && !members[region].empty() ? members[region] : members[0];
        nearest.clear();
        // A place is as far along its region as the one that lends its colour: regions reach over unlike distances.
        const bool matched = &pool != &members[0];
        const Span &own = toSpans[matched ? static_cast<size_t>(mean.region) : 0],
                   &its = fromSpans[matched ? region : 0];
        // The thesis knows the structural distance alone, as it is.
        const bool plain = parameters.asThesis;
        const float distance = plain ? mean.distance : its.at(0, own.share(0, mean.distance));
        const float vein = its.at(1, own.share(1, mean.veinDistance));
        for (const int e : pool) {
          const SuperpixelMean& other = source[static_cast<size_t>(e)].mean;
          const float ds = distance - other.distance, dg = plain ? 0 : vein - other.veinDistance;
          nearest.emplace_back(ds * ds + dg * dg, e);
        }
        const auto count = std::min<size_t>(static_cast<size_t>(std::max(1, parameters.candidates)), nearest.size());
        std::partial_sort(nearest.begin(), nearest.begin() + static_cast<std::ptrdiff_t>(count), nearest.end());
        const int tries = coarser ? std::max(1, parameters.choices) : 1;
        const SuperpixelMean* chosen = nullptr;
        float best = 1e30f;
        for (int attempt = 0; attempt < tries; ++attempt) {
          const std::uint32_t bits = hash(seed, 400 + static_cast<std::uint32_t>(n), static_cast<std::uint32_t>(k),
                                          static_cast<std::uint32_t>(attempt));
          const auto drawn = static_cast<size_t>((static_cast<std::uint64_t>(bits) * count) >> 32u);
          const SuperpixelMean& candidate = source[static_cast<size_t>(nearest[drawn].second)].mean;
          const float fit =
              coarser ? squareDistance(candidate.lab, (*coarser)[static_cast<size_t>(level[k].parent)].mean.lab) : 0;
          if (!chosen || fit < best) best = fit, chosen = &candidate;
        }
        std::copy(std::begin(chosen->lab), std::end(chosen->lab), std::begin(mean.lab));
      }
    }
  }
  std::vector<SuperpixelMean> result;
  for (const SuperpixelPlace& place : to.back()) result.push_back(place.mean);
  return result;
}

std::vector<float> synthesizeClassic(const LeafStages& target, const LeafStages& example,
                                     const std::vector<float>& colours, const std::vector<int>& match,
                                     const SynthesisParameters& parameters, quint64 seed, Progress& progress) {
  const std::vector<SuperpixelMean> chosen = chooseSuperpixels(target, example, colours, match, parameters, seed);
  if (chosen.empty() || progress.cancelled()) return {};
  progress.report(0.3);
  std::vector<float> result = smoothLayer(target.grown, chosen, parameters.smoothing);
  if (!parameters.detail) return result;
  if (progress.cancelled()) return {};
  progress.report(0.5);
  // What the example has beyond its own smooth layer is its detail.
  std::vector<float> detail =
      smoothLayer(example.seen, describeSuperpixels(example.seen, colours.data()), parameters.smoothing);
  for (size_t i = 0; i < detail.size(); ++i) {
    detail[i] = example.seen.superpixels.values[i / 3] > 0 ? colours[i] - detail[i] : 0;
  }
  if (progress.cancelled()) return {};
  RandomSequence random(seed, 421);
  const std::vector<float> fine = layDetail(target.grown, {&example.seen, &detail}, random, progress);
  if (progress.cancelled()) return {};
  for (size_t i = 0; i < result.size(); ++i) result[i] += fine[i];
  return result;
}

}  // namespace windfall::model
