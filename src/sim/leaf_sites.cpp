#include "sim/leaf_sites.h"

#include <algorithm>

#include "kernels/elementary.h"
#include "kernels/leaf_traits.h"
#include "kernels/quaternion.h"
#include "kernels/random.h"

namespace windfall::sim {

namespace {

/// The `copy`th further leaf of a site: up to 2 cm along the link, turned about it by a golden angle and some.
LeafSite movedSite(const LeafSite& site, const Link& link, std::uint32_t copy, std::uint64_t seed, std::uint32_t leaf) {
  const float turns = 0.381966f * static_cast<float>(copy) + 0.1f * uniform(seed, leaf, 1);
  const vec4 turn = turnAbout({0, 0, 1}, turns - std::floor(turns));
  LeafSite moved = site;
  moved.position = rotate(turn, site.position);
  const float along = moved.position.z + 0.04f * (uniform(seed, leaf, 2) - 0.5f);
  const float low = std::min(0.0f, site.position.z), high = std::max(link.length, site.position.z);
  moved.position.z = std::clamp(along, low, high);
  const vec4 q = compose(turn, vec4(site.rotation.x, site.rotation.y, site.rotation.z, site.rotation.w));
  moved.rotation = quat(q.w, q.x, q.y, q.z);
  moved.size *= 0.85f + 0.3f * uniform(seed, leaf, 3);
  return moved;
}

}  // namespace

std::vector<LeafPlace> chooseSites(const std::vector<TreeInstance>& trees, std::uint32_t count, std::uint64_t seed) {
  std::uint64_t sites = 0;
  for (const TreeInstance& instance : trees) sites += instance.tree->sites.size();
  std::vector<LeafPlace> places;
  if (sites == 0) return places;
  places.reserve(count);
  std::uint32_t leaf = 0, firstLink = 0;
  std::uint64_t firstSite = 0;
  for (const TreeInstance& instance : trees) {
    const Tree& tree = *instance.tree;
    const std::uint64_t endSite = firstSite + tree.sites.size();
    for (; leaf < count; ++leaf) {
      // The leaf's own stretch of the sites; of one that has none of its own, the site it shares.
      const std::uint64_t low = leaf * sites / count, high = (leaf + std::uint64_t{1}) * sites / count;
      const std::uint64_t chosen = high > low ? low + hash(seed, leaf) % (high - low) : low;
      if (chosen >= endSite) break;
      const LeafSite& site = tree.sites[chosen - firstSite];
      const auto link = static_cast<std::uint32_t>(site.link);
      // The site's first leaf is the least k with k * sites / count = site.
      const std::uint64_t first = (chosen * count + sites - 1) / sites;
      const auto copy = count > sites ? static_cast<std::uint32_t>(leaf - first) : 0u;
      places.push_back({firstLink + link, copy == 0 ? site : movedSite(site, tree.links[link], copy, seed, leaf),
                        static_cast<std::uint32_t>(&instance - trees.data()),
                        static_cast<std::uint32_t>(chosen - firstSite)});
    }
    firstLink += static_cast<std::uint32_t>(tree.links.size());
    firstSite = endSite;
  }
  return places;
}

}  // namespace windfall::sim
