// A forest cut into subtrees that threads work on alone (tree_dynamics.md, 10, scheme 1).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kernels/cuda/link_solver.h"

namespace windfall::sim {

/// Links [begin, end): a whole subtree, its root first.
struct Treelet {
  std::uint32_t begin = 0, end = 0;
};

/// A link above all treelets, or (treelet >= 0) the root of one, whose load goes up to its parent.
struct Crossing {
  std::uint32_t link = 0;
  std::int32_t treelet = -1;
};

/// The cut depends on the tree alone, never on the number of threads.
struct Partition {
  std::vector<Treelet> treelets;
  /// All links; those of a treelet at its begin..end, level by level from its root. Neighbours in this order do not
  /// wait for each other's results, as a parent and its first child do.
  std::vector<std::uint32_t> order;
  std::vector<std::uint32_t> groups;  ///< group g is treelets groups[g] .. groups[g + 1]; about equal work
  std::vector<std::uint32_t> top;     ///< links above all treelets, parents first
  std::vector<Crossing> crossings;    ///< top links and treelet roots with a parent, highest index first
};

/// `parents` in preorder over the whole forest. A treelet has at most `size` links.
Partition partition(std::span<const std::int32_t> parents, std::uint32_t size);

/// The same cut for threads that work in groups (kernels/link_treelet.h).
cuda::Forest forestOf(const Partition& cut, std::span<const std::int32_t> parents);

}  // namespace windfall::sim
