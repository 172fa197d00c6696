// Air that brakes the twist of branches which the mean wind has bent.
#pragma once

#include <vector>

#include "sim/factor.h"

namespace windfall::sim {

/// What the drag of everything outboard adds to each joint's damping of twist, N m s, since it is bent by gusts of
/// twice the mean wind: a bent twig that twists sweeps through the air, while the drag's matrix of the straight rest
/// pose (tree_dynamics.md, 6.1) sees it turn on the spot. Without it twigs flutter in a steady wind and twist past 3
/// rad in storms (tests V6, V7). 0 in calm air.
std::vector<double> bentTwistDrag(const std::vector<LinkBody>& bodies, const FactorSettings& settings);

}  // namespace windfall::sim
