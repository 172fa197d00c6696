#include "sim/treelets.h"

#include <algorithm>
#include <numeric>

namespace windfall::sim {

Partition partition(std::span<const std::int32_t> parents, std::uint32_t size) {
  const auto count = static_cast<std::uint32_t>(parents.size());
  std::vector<std::uint32_t> below(count, 1);
  for (std::uint32_t i = count; i-- > 0;) {
    if (parents[i] >= 0) below[static_cast<std::size_t>(parents[i])] += below[i];
  }
  Partition cut;
  std::uint32_t inGroup = size;
  for (std::uint32_t i = 0; i < count;) {
    if (below[i] > size) {
      cut.top.push_back(i);
      cut.crossings.push_back({i, -1});
      ++i;
      continue;
    }
    if (inGroup >= size) {
      cut.groups.push_back(static_cast<std::uint32_t>(cut.treelets.size()));
      inGroup = 0;
    }
    if (parents[i] >= 0) cut.crossings.push_back({i, static_cast<std::int32_t>(cut.treelets.size())});
    cut.treelets.push_back({i, i + below[i]});
    inGroup += below[i];
    i += below[i];
  }
  cut.groups.push_back(static_cast<std::uint32_t>(cut.treelets.size()));

  std::vector<std::uint32_t> depth(count, 0);
  for (std::uint32_t i = 0; i < count; ++i) {
    if (parents[i] >= 0) depth[i] = depth[static_cast<std::size_t>(parents[i])] + 1;
  }
  cut.order.resize(count);
  std::iota(cut.order.begin(), cut.order.end(), 0u);
  for (const Treelet& part : cut.treelets) {
    std::stable_sort(cut.order.begin() + part.begin, cut.order.begin() + part.end,
                     [&](std::uint32_t a, std::uint32_t b) { return depth[a] < depth[b]; });
  }
  for (std::size_t i = 0, j = cut.crossings.size(); i + 1 < j; ++i) std::swap(cut.crossings[i], cut.crossings[--j]);
  return cut;
}

cuda::Forest forestOf(const Partition& cut, std::span<const std::int32_t> parents) {
  const std::size_t count = parents.size();
  std::vector<std::uint32_t> depth(count, 0);
  for (std::size_t i = 0; i < count; ++i) {
    if (parents[i] >= 0) depth[i] = depth[static_cast<std::size_t>(parents[i])] + 1;
  }
  cuda::Forest forest;
  const auto addPart = [&](std::vector<std::uint32_t> links) {
    std::stable_sort(links.begin(), links.end(), [&](std::uint32_t a, std::uint32_t b) { return depth[a] < depth[b]; });
    forest.parts.push_back(static_cast<std::uint32_t>(forest.levels.size()));
    for (std::size_t k = 0; k < links.size(); ++k) {
      if (k == 0 || depth[links[k]] != depth[links[k - 1]]) {
        forest.levels.push_back(static_cast<std::uint32_t>(forest.order.size()));
      }
      forest.order.push_back(links[k]);
    }
  };
  addPart(cut.top);
  for (const Treelet& part : cut.treelets) {
    addPart({cut.order.begin() + part.begin, cut.order.begin() + part.end});
  }
  forest.parts.push_back(static_cast<std::uint32_t>(forest.levels.size()));
  forest.levels.push_back(static_cast<std::uint32_t>(forest.order.size()));

  forest.childBegin.assign(count + 1, 0);
  for (const std::int32_t parent : parents) {
    if (parent >= 0) ++forest.childBegin[static_cast<std::size_t>(parent) + 1];
  }
  std::partial_sum(forest.childBegin.begin(), forest.childBegin.end(), forest.childBegin.begin());
  std::vector<std::uint32_t> next(forest.childBegin.begin(), forest.childBegin.end() - (count > 0 ? 1 : 0));
  forest.children.resize(forest.childBegin.back());
  for (std::size_t i = count; i-- > 0;) {
    if (parents[i] >= 0) forest.children[next[static_cast<std::size_t>(parents[i])]++] = static_cast<std::uint32_t>(i);
  }
  return forest;
}

}  // namespace windfall::sim
