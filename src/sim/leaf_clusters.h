// Which leaves of a tree are drawn as one from afar: clusters along its twigs, and boughs of clusters.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/tree.h"

namespace windfall::sim {

/// Leaves that move together. Rest pose, the tree's own space.
struct LeafCluster {
  std::int32_t link = 0;     ///< the joint that carries it: the nearest common ancestor of its leaves' links
  std::int32_t parent = -1;  ///< its bough; of a bough: -1
  vec3 center{0};
  float radius = 0;              ///< m, all blades lie within
  std::uint32_t firstChild = 0;  ///< of a bough: its clusters stand together
  std::uint32_t childCount = 0;
};

struct LeafClusters {
  std::vector<LeafCluster> nodes;  ///< boughs first, then the clusters
  std::uint32_t boughs = 0;
  std::vector<std::uint32_t> ofSite;  ///< the cluster (place in `nodes`) of each of the tree's sites
};

struct ClusterLimits {
  double sites = 64;       ///< in a cluster, at most
  float reach = 6;         ///< half a cluster's size, at most, in mean leaf lengths
  std::size_t most = 200;  ///< clusters and boughs; where there would be more, the other limits are raised
};

/// Groups the leaf sites of a tree, following its twigs from their tips, so that every cluster hangs on as few of them
/// as can be; too many at one joint are parted in space. The same tree gives the same clusters.
LeafClusters clusterLeaves(const Tree& tree, const ClusterLimits& limits = {});

}  // namespace windfall::sim
