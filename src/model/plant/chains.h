// Which segments continue each other: the botanical axes of a skeleton (plant_meshing.md, 1.1).
#pragma once

#include <cstdint>
#include <vector>

#include "model/plant/skeleton_graph.h"

namespace windfall::model {

enum class ChainRule {
  Longest,  ///< the child with the longest way to a tip (Grossfurtner 2023)
  Score,    ///< angle, length, thickness and order weighed together (after Pirk 2013)
};

struct ChainSettings {
  ChainRule rule = ChainRule::Score;
  /// Of the score; only their proportions matter.
  double angle = 0.35, length = 0.30, thickness = 0.25, order = 0.10;
  bool operator==(const ChainSettings&) const = default;
};

/// Segments `links[first]` to `links[first + count - 1]`, from base to tip.
struct Chain {
  std::uint32_t first = 0, count = 0;
  std::int32_t parent = -1;         ///< chain that it leaves
  std::int32_t parentSegment = -1;  ///< segment that it leaves
  std::int32_t order = 1;           ///< Gravelius: 1 for what starts at a root of the tree, its parent's + 1
};

/// Every segment is in exactly one chain; a chain stands after its parent.
struct Chains {
  std::vector<Chain> chains;
  std::vector<std::uint32_t> links;     ///< segments, chain by chain
  std::vector<std::int32_t> ofSegment;  ///< a segment: its chain
  std::vector<std::uint32_t> place;     ///< a segment: its place in that chain, 0 at the base
  std::vector<std::int32_t> strahler;   ///< a segment: 1 at a tip
  std::vector<float> reach;             ///< a segment: longest way from its base to a tip, m
};

/// The choice depends on the geometry alone, never on the order of siblings in the file; a branch that the source names
/// (Segment::branch) wins over both rules. O(n). `graph` as sortedGraph and finishGraph leave it.
Chains findChains(const SkeletonGraph& graph, const ChainSettings& settings = {});

}  // namespace windfall::model
