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
  std::vector<int> match;
  for (const RegionShape& shape : targets) {
    std::vector<int> order(examples.size());
    std::iota(order.begin(), order.end(), 0);
    std::vector<double> score;
    for (const RegionShape& other : examples) score.push_back(similarity(shape, other));
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return score[static_cast<size_t>(a)] > score[static_cast<size_t>(b)]; });
    const size_t best = std::min(order.size(), std::max<size_t>(3, (order.size() + 4) / 5));
    match.push_back(best == 0 ? 0 : order[random.below(static_cast<std::uint32_t>(best))] + 1);
  }
  return match;
}

}  // namespace windfall::model
