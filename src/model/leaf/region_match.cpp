#include "model/leaf/region_match.h"

#include <algorithm>
#include <cmath>
#include <numeric>

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
      std::sort(region.begin(), region.end());
      const auto last = static_cast<double>(region.size() - 1);
      shape.low = region[static_cast<size_t>(0.02 * last)];
      shape.high = region[static_cast<size_t>(0.98 * last)];
      shape.area = static_cast<double>(region.size()) / static_cast<double>(leaf);
    }
    shapes.push_back(shape);
  }
  return shapes;
}

double similarity(const RegionShape& a, const RegionShape& b) {
  if (a.area <= 0 || b.area <= 0) return 0;
  const double joint = std::min(a.high, b.high) - std::max(a.low, b.low);
  const double whole = std::max(a.high, b.high) - std::min(a.low, b.low);
  const double overlap = whole > 0 ? std::max(0.0, joint) / whole : 1;
  const double ratio = std::log(a.area / b.area);
  return overlap * std::exp(-ratio * ratio / (2 * 0.6 * 0.6));
}

std::vector<int> matchRegions(const LeafStructure& target, const LeafStructure& example, RandomSequence& random) {
  const std::vector<RegionShape> targets = describeRegions(target), examples = describeRegions(example);
  std::vector<int> match(targets.size(), 0);
  if (examples.empty()) return match;
  // A region that lends its lesions more than twice is seen to repeat; few regions have to lend more often.
  const auto most = static_cast<int>(std::max<size_t>(2, (targets.size() + examples.size() - 1) / examples.size() + 1));
  std::vector<int> used(examples.size(), 0);
  // By chance who chooses first.
  std::vector<size_t> turns(targets.size());
  std::iota(turns.begin(), turns.end(), size_t{0});
  for (size_t i = turns.size(); i > 1; --i) std::swap(turns[i - 1], turns[random.below(static_cast<std::uint32_t>(i))]);
  const size_t best = std::min(examples.size(), std::max<size_t>(3, (examples.size() + 4) / 5));
  for (const size_t turn : turns) {
    std::vector<int> order;
    std::vector<double> score;
    for (size_t e = 0; e < examples.size(); ++e) {
      score.push_back(similarity(targets[turn], examples[e]));
      if (used[e] < most) order.push_back(static_cast<int>(e));
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return score[static_cast<size_t>(a)] > score[static_cast<size_t>(b)]; });
    const auto choice = static_cast<std::uint32_t>(std::min(best, order.size()));
    const int chosen = order[random.below(choice)];
    ++used[static_cast<size_t>(chosen)];
    match[turn] = chosen + 1;
  }
  return match;
}

}  // namespace windfall::model
