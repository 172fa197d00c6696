// The first cantilever mode of every axis of a tree by itself: what the analytic solver's joints are calibrated to
// (tree_dynamics.md, 5.7).
#pragma once

#include <span>
#include <vector>

#include "sim/bodies.h"

namespace windfall::sim {

/// An axis swaying by itself, its side axes rigid and its base held.
struct AxisMode {
  double square = 0;   ///< squared angular frequency, 1/s2
  double airRate = 0;  ///< damping by the air over mass, sum c v2 / sum m v2, 1/s (5.8)
};

/// The mode of the axis that each link belongs to. `drags` are the composites of the drag's slope in the place of mass,
/// of each link.
std::vector<AxisMode> axisModes(const std::vector<LinkBody>& bodies, const std::vector<Composite>& composites,
                                const std::vector<Composite>& drags);

}  // namespace windfall::sim
