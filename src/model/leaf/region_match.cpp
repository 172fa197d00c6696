#include "model/leaf/region_match.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "model/leaf/joined_examples.h"

namespace windfall::model {

std::vector<RegionShape> describeRegions(const LeafStructure& structure) {
  std::vector<std::vector<float>> values(static_cast<size_t>(structure.regions.count));
  size_t leaf = 0;
  for (size_t i = 0; i < structure.regions.values.size(); ++i) {
    const qint32 region = structure.regions.values[i];
    if (region <= 0) continue;
    values[static_cast<size_t>(region - 1)].push_back(structure.distance.values[i]);
    ++leaf;
  }
  std::vector<RegionShape> shapes;
  for (std::vector<float>& region : values) {
    RegionShape shape;
    if (!region.empty()) {
      const auto last = static_cast<double>(region.size() - 1);
      const auto low = region.begin() + static_cast<std::ptrdiff_t>(0.02 * last),
                 high = region.begin() + static_cast<std::ptrdiff_t>(0.98 * last);
      std::nth_element(region.begin(), high, region.end());
      std::nth_element(region.begin(), low, high);
      shape.low = *low;
      shape.high = *high;
      const std::vector<double>& wholes = structure.regions.wholes;
      const double whole = wholes.empty() ? static_cast<double>(leaf) : wholes[shapes.size()];
      shape.area = static_cast<double>(region.size()) / whole;
      shape.lowest = *std::min_element(region.begin(), low + 1);
      shape.highest = *std::max_element(high, region.end());
      shape.pixels = static_cast<double>(region.size());
    }
    shapes.push_back(shape);
  }
  return shapes;
}

namespace {

/// Of target and example, each by a thread of its own.
std::array<std::vector<RegionShape>, 2> describeBoth(const LeafStructure& target, const LeafStructure& example) {
  std::array<std::vector<RegionShape>, 2> shapes;
#pragma omp parallel for schedule(static, 1)
  for (int leaf = 0; leaf < 2; ++leaf)
    shapes[static_cast<size_t>(leaf)] = describeRegions(leaf == 0 ? target : example);
  return shapes;
}

double overlap(double lowA, double highA, double lowB, double highB) {
  const double joint = std::min(highA, highB) - std::max(lowA, lowB);
  const double whole = std::max(highA, highB) - std::min(lowA, lowB);
  return whole > 0 ? std::max(0.0, joint) / whole : 1;
}

}  // namespace

double similarity(const RegionShape& a, const RegionShape& b) {
  if (a.area <= 0 || b.area <= 0) return 0;
  const double ratio = std::log(a.area / b.area);
  return overlap(a.low, a.high, b.low, b.high) * std::exp(-ratio * ratio / (2 * 0.6 * 0.6));
}

double thesisSimilarity(const RegionShape& a, const RegionShape& b) {
  if (a.area <= 0 || b.area <= 0) return 0;
  const double difference = a.pixels - b.pixels;
  return overlap(a.lowest, a.highest, b.lowest, b.highest) / (1 + difference * difference);
}

std::vector<int> matchRegions(const LeafStructure& target, const LeafStructure& example, RandomSequence& random,
                              const RegionParameters& parameters) {
  const auto [targets, examples] = describeBoth(target, example);
  const auto alike = parameters.scaleFree ? similarity : thesisSimilarity;
  std::vector<int> match(targets.size(), 0);
  if (examples.empty()) return match;
  // A region that lends its lesions more than twice is seen to repeat; few regions have to lend more often.
  const auto most = static_cast<int>(std::max<size_t>(2, (targets.size() + examples.size() - 1) / examples.size() + 1));
  std::vector<int> used(examples.size(), 0);
  // By chance who chooses first.
  std::vector<size_t> turns(targets.size());
  std::iota(turns.begin(), turns.end(), size_t{0});
  for (size_t i = turns.size(); i > 1; --i) std::swap(turns[i - 1], turns[random.below(static_cast<std::uint32_t>(i))]);
  const auto share = static_cast<size_t>(std::ceil(parameters.best * static_cast<double>(examples.size()) - 1e-9));
  const size_t best = std::min(examples.size(), std::max<size_t>(3, share));
  for (const size_t turn : turns) {
    // A petiole is like no part of a blade.
    if (static_cast<int>(turn) + 1 == target.regions.petiole) {
      match[turn] = example.regions.petiole;
      continue;
    }
    std::vector<int> order;
    std::vector<double> score;
    for (size_t e = 0; e < examples.size(); ++e) {
      score.push_back(alike(targets[turn], examples[e]));
      if (used[e] < most && static_cast<int>(e) + 1 != example.regions.petiole) order.push_back(static_cast<int>(e));
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return score[static_cast<size_t>(a)] > score[static_cast<size_t>(b)]; });
    if (order.empty()) continue;
    const auto choice = static_cast<std::uint32_t>(std::min(best, order.size()));
    const int chosen = order[random.below(choice)];
    ++used[static_cast<size_t>(chosen)];
    match[turn] = chosen + 1;
  }
  return match;
}

std::vector<int> matchRegionsAsThesis(const LeafStructure& target, const LeafStructure& example, RandomSequence& random,
                                      double best) {
  const auto [targets, examples] = describeBoth(target, example);
  std::vector<int> match(targets.size(), 0);
  if (examples.empty()) return match;
  const auto kept = std::max<size_t>(1, static_cast<size_t>(best * static_cast<double>(examples.size())));
  for (size_t t = 0; t < targets.size(); ++t) {
    std::vector<std::pair<double, int>> order;
    for (size_t e = 0; e < examples.size(); ++e) {
      order.emplace_back(-thesisSimilarity(targets[t], examples[e]), static_cast<int>(e) + 1);
    }
    std::sort(order.begin(), order.end());
    match[t] = order[random.below(static_cast<std::uint32_t>(std::min(kept, order.size())))].second;
  }
  return match;
}

int regionAt(const LeafStages& stages, const LabelField& regions, QPointF photo) {
  const QPointF working = stages.toWorking(photo);
  const int x = static_cast<int>(std::floor(working.x())), y = static_cast<int>(std::floor(working.y()));
  if (x < 0 || y < 0 || x >= regions.size.width() || y >= regions.size.height()) return 0;
  return regions.values[static_cast<size_t>(y) * static_cast<size_t>(regions.size.width()) + static_cast<size_t>(x)];
}

std::vector<int> chooseRegions(const LeafStages& target, const LeafStages& example, RandomSequence& random,
                               bool asThesis) {
  const RegionParameters& parameters = target.made.parameters.regions;
  const auto choose = [&](RandomSequence& by) {
    return asThesis ? matchRegionsAsThesis(target.grown, example.seen, by, parameters.best)
                    : matchRegions(target.grown, example.seen, by, parameters);
  };
  std::vector<int> match = choose(random);
  if (parameters.hold) {
    RandomSequence held(parameters.seed, 211);
    match = choose(held);
  }
  for (const RegionPair& pair : target.made.regionPairs) {
    const int to = regionAt(target, target.grown.regions, pair.target);
    const int from = exampleRegionAt(example, pair.example, target.made.id, pair.source);
    if (to > 0 && from > 0 && to <= static_cast<int>(match.size())) match[static_cast<size_t>(to - 1)] = from;
  }
  return match;
}

}  // namespace windfall::model
