// Which leaf hangs where: sites of all trees of a scene shared out among a number of leaves.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/engine.h"

namespace windfall::sim {

/// A leaf's place on a link of the whole scene.
struct LeafPlace {
  std::uint32_t link = 0;  ///< through all instances, in the scene's order
  LeafSite site;
  std::uint32_t tree = 0;   ///< which of the trees
  std::uint32_t place = 0;  ///< which of the tree's sites
};

/// `count` places: a hashed choice, even over the sites, where there are more sites than leaves; else every site in
/// turn, its further leaves moved along the link and turned about it. Empty where no tree has a site.
std::vector<LeafPlace> chooseSites(const std::vector<TreeInstance>& trees, std::uint32_t count, std::uint64_t seed);

}  // namespace windfall::sim
