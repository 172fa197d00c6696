// Makes the tile of turbulence that kernels/eddy_tile.h reads.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "kernels/eddy_tile.h"

namespace windfall::sim {

/// kTileNodes nodes of periodic gradient noise in four octaves with amplitudes by Kolmogorov's u ~ size^(1/3); each
/// component has mean 0 and, trilinearly sampled, root mean square 1. The same seed gives the same bits. Made once a
/// seed and shared while somebody holds it; safe from any thread.
std::shared_ptr<const std::vector<vec4>> eddyTile(std::uint64_t seed);

}  // namespace windfall::sim
