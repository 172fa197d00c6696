// The loop that evaluates the wind on a lattice on the CPU, for the best instruction set of the machine.
#pragma once

#include <cstddef>

#include "kernels/wind_model.h"

namespace windfall {

/// Places of a lattice, x fastest.
struct WindLattice {
  int nx = 0, ny = 0;
  vec3 origin{0}, spacing{1};  ///< m
};

/// Air velocity at nodes begin..end.
void windRange(const WindMoment& wind, const WindLattice& lattice, std::size_t begin, std::size_t end, vec4* nodes);

}  // namespace windfall
