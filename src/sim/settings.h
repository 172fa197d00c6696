// What an artist sets for wind and leaves; plain values with sensible defaults.
#pragma once

#include <cstdint>

#include "kernels/math.h"

namespace windfall::sim {

/// Wind over open ground (tree_dynamics.md, 8).
struct WindSettings {
  float speed = 5;            ///< mean at 10 m height, m/s
  vec3 direction{1, 0, 0};    ///< where it blows to; horizontal part is used
  float turbulence = 0.2f;    ///< standard deviation over mean, 0..0.6
  float gustStrength = 0.6f;  ///< travelling fronts: A of the note, 0..1.5
  float gustPeriod = 9;       ///< seconds between fronts
  float until = 1e30f;        ///< s; calm afterwards
  std::uint64_t seed = 1;
  bool operator==(const WindSettings&) const = default;
};

/// Leaves that come loose and fall (falling_leaves.md; release by tree_dynamics.md, 9).
struct LeafSettings {
  std::int32_t count = 2000;  ///< leaves in the scene
  /// 0 green and firm .. 1 ready to drop; half-way a breeze takes about one leaf in a hundred each second.
  float season = 0.5f;
  float spawnHeight = 0;      ///< m; above 0: leaves start loose at this height over a disc instead of on the trees
  float massPerArea = 0.10f;  ///< kg/m2
  bool respawn = false;       ///< a leaf on the ground grows again at its place after a while
  bool operator==(const LeafSettings&) const = default;
};

/// Links' solver.
struct SolverSettings {
  float step = 1.f / 60;            ///< fixed step, s
  float structuralDamping = 0.03f;  ///< modal ratio
  bool operator==(const SolverSettings&) const = default;
};

}  // namespace windfall::sim
