// Whether a tree can carry its own weight (tree_dynamics.md, 2.7).
#pragma once

#include "sim/tree.h"

namespace windfall::sim {

/// Largest eigenvalue of K^-1 G, with G the change of the torque of gravity by the joint angles: the share of its
/// buckling load that the tree's own weight is. Below 0.5 a tree stands well, above 1 it cannot carry itself; 0 where
/// everything hangs.
double selfBuckling(const Tree& tree);

}  // namespace windfall::sim
