// A broadleaf tree made by rule, for tests and benchmarks: the prototype of tree_dynamics.md, 2.6.
#pragma once

#include <array>
#include <cstdint>

#include "sim/tree.h"

namespace windfall::sim {

/// Trunk, limbs, branches and twigs; the defaults give 1,906 links.
struct SampleTreeSettings {
  float height = 10;                         ///< m
  float baseRadius = 0.10f;                  ///< m
  float youngsModulus = 6e9f;                ///< Pa
  int orders = 4;                            ///< 1: the trunk alone
  std::array<int, 4> segments{10, 6, 4, 3};  ///< links of an axis, by order
  std::array<int, 3> children{12, 8, 5};     ///< side axes of an axis, by order
  bool leaves = true;
  int sitesPerLink = 2;  ///< leaf sites on each link of the last order
  std::uint64_t seed = 1;
};

Tree sampleTree(const SampleTreeSettings& settings = {});

/// The sample tree of about 10,000 links.
SampleTreeSettings tenThousandLinks();

/// Broadleaves of about 1,000, 10,000, 100,000 and 1,000,000 links, for benchmarks; and conifers whose trunk alone is
/// 300 links deep.
SampleTreeSettings broadleafOf(std::size_t links);
SampleTreeSettings coniferOf(std::size_t links);

/// A straight uniform cantilever along +x (lying) or +y (standing), without leaves.
Tree cantilever(int links, float length, float radius, bool standing = true);

}  // namespace windfall::sim
