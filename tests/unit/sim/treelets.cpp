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

TEST_CASE("every link has one slot, parents come in earlier rounds, and treelets are whole") {
  const std::vector<std::int32_t> parents = parentsOf(sampleTree(), 3);
  const auto count = static_cast<std::uint32_t>(parents.size());
  for (const std::uint32_t size : {1u, 7u, 100u, 512u, 100000u}) {
    for (const std::uint32_t width : {16u, 128u}) {
      CAPTURE(size);
      CAPTURE(width);
      const Arrangement slots = arrange(parents, size, 2 * size, width);
      CHECK(slots.link.size() % width == 0);
      std::vector<int> seen(count), partOf(count);
      bool early = true, whole = true;
      for (std::size_t p = 0; p < slots.parts.size(); ++p) {
        for (std::uint32_t s = slots.parts[p].begin * 16; s < slots.parts[p].end * 16; ++s) {
          const std::uint32_t link = slots.link[s];
          if (link >= count) continue;
          ++seen[link];
          partOf[link] = static_cast<int>(p);
          if (parents[link] < 0) {
            CHECK(slots.parent[s] == slots.ground());
            continue;
          }
          const auto above = static_cast<std::uint32_t>(parents[link]);
          CHECK(slots.parent[s] == above);
          const bool crosses = slots.target[s] != above;
          // A parent is in the same part and an earlier round, or above all treelets.
          const std::uint32_t slot = slots.slot[above];
          if (partOf[above] == static_cast<int>(p))
            early = early && slot / width < s / width;
          else
            whole = whole && partOf[above] == 0 && crosses;
        }
      }
      CHECK(early);
      CHECK(whole);
      CHECK(std::all_of(seen.begin(), seen.end(), [](int n) { return n == 1; }));
    }
  }
}

TEST_CASE("rounds are filled well") {
  const std::vector<std::int32_t> parents = parentsOf(sampleTree(tenThousandLinks()), 1);
  const Arrangement slots = arrange(parents, 512, 1024, 16);
  CHECK(static_cast<double>(parents.size()) / static_cast<double>(slots.link.size()) > 0.85);
}

TEST_CASE("an empty forest has no slots") {
  const Arrangement slots = arrange({}, 512, 1024, 16);
  CHECK(slots.link.empty());
  CHECK(slots.parts.size() == 1);
  CHECK(slots.crossings.empty());
}
