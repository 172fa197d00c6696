// How much leaves and wood slow the air behind them, at the nodes of the wind's lattice (tree_dynamics.md, 8).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kernels/wind_loops.h"

namespace windfall::sim {

/// Leaves and wood at a place.
struct Foliage {
  vec3 place{0};   ///< m, world
  float area = 0;  ///< m2 that stand in the wind: one-sided leaf area and the wood's frontal area
};

/// Shares of the wind that reach a place, for eight directions; made once of the foliage at rest.
class ShelterMap {
 public:
  static constexpr int kAzimuths = 8;

  ShelterMap() = default;
  /// Marches upwind from every node through voxels of leaf area: dU/ds = -U a Cd / 2 (Cd 0.15, which gives the drag
  /// length of 21 m at the leaf area density of 0.3 m2/m3 that the note's source measured), and wakes that mix with the
  /// wind around over 40 m.
  ShelterMap(std::span<const Foliage> foliage, const WindLattice& lattice, int nz, int threads);

  bool empty() const { return shares_.empty(); }
  /// Share 0..1 of the wind at a node that blows to the unit vector `direction`.
  float at(std::size_t node, const vec3& direction) const;

 private:
  std::vector<std::uint8_t> shares_;  ///< kAzimuths a node, clockwise from north
};

}  // namespace windfall::sim
