#include "sim/treelets.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "sim/sample_tree.h"

using namespace windfall::sim;

namespace {

std::vector<std::int32_t> parentsOf(const Tree& tree, int copies) {
  std::vector<std::int32_t> parents;
  for (int c = 0; c < copies; ++c) {
    const auto first = static_cast<std::int32_t>(parents.size());
    for (const Link& link : tree.links) parents.push_back(link.parent < 0 ? -1 : link.parent + first);
  }
  return parents;
}

}  // namespace

TEST_CASE("a partition holds every link once, in whole subtrees of the size asked for") {
  const std::vector<std::int32_t> parents = parentsOf(sampleTree(), 3);
  for (const std::uint32_t size : {1u, 7u, 100u, 512u, 100000u}) {
    CAPTURE(size);
    const Partition cut = partition(parents, size);
    std::vector<int> seen(parents.size());
    for (const std::uint32_t link : cut.top) ++seen[link];
    for (const Treelet& part : cut.treelets) {
      CHECK(part.end - part.begin <= size);
      for (std::uint32_t i = part.begin; i < part.end; ++i) {
        ++seen[i];
        if (i > part.begin) CHECK(parents[i] >= static_cast<std::int32_t>(part.begin));
      }
      if (part.end < parents.size()) CHECK(parents[part.end] < static_cast<std::int32_t>(part.begin));
    }
    CHECK(std::all_of(seen.begin(), seen.end(), [](int n) { return n == 1; }));
    CHECK(cut.groups.front() == 0);
    CHECK(cut.groups.back() == cut.treelets.size());
    CHECK(std::is_sorted(cut.crossings.begin(), cut.crossings.end(),
                         [](const Crossing& a, const Crossing& b) { return a.link > b.link; }));
  }
}

TEST_CASE("an empty forest has an empty partition") {
  const Partition cut = partition({}, 512);
  CHECK(cut.treelets.empty());
  CHECK(cut.top.empty());
}
