// Turbulence as a periodic tile that is scrolled with the wind (tree_dynamics.md, 8): one lookup instead of a sum of
// noise.
#pragma once

#include <cmath>
#include <cstddef>

#include "kernels/math.h"

namespace windfall {

/// Nodes of the tile along x, y and z; powers of two. It repeats in all three directions.
inline constexpr int kTileX = 64, kTileY = 32, kTileZ = 64;
inline constexpr std::size_t kTileNodes = std::size_t{kTileX} * kTileY * kTileZ;
/// Octaves in the tile; the largest cell is 16 nodes wide, the smallest 2.
inline constexpr int kTileOctaves = 4;

/// Three decorrelated components of root mean square 1 at `p` (in nodes), trilinear. Anything that is no number, or
/// farther than a million nodes, counts as 0.
WINDFALL_HD vec3 eddyAt(const vec4* tile, const vec3& p) {
  const auto sane = [](float v) { return v > -1e6f ? (v < 1e6f ? v : 0.f) : 0.f; };
  const float x = sane(p.x), y = sane(p.y), z = sane(p.z);
  const float bx = std::floor(x), by = std::floor(y), bz = std::floor(z);
  const float fx = x - bx, fy = y - by, fz = z - bz;
  const int x0 = static_cast<int>(bx) & (kTileX - 1), x1 = (x0 + 1) & (kTileX - 1);
  const int y0 = (static_cast<int>(by) & (kTileY - 1)) * kTileX, y1 = (y0 + kTileX) & (kTileY * kTileX - 1);
  constexpr int kSlice = kTileX * kTileY;
  const int z0 = (static_cast<int>(bz) & (kTileZ - 1)) * kSlice, z1 = (z0 + kSlice) & (kTileZ * kSlice - 1);
  const vec4 a = (tile[z0 + y0 + x0] * (1 - fx) + tile[z0 + y0 + x1] * fx) * (1 - fy) +
                 (tile[z0 + y1 + x0] * (1 - fx) + tile[z0 + y1 + x1] * fx) * fy;
  const vec4 b = (tile[z1 + y0 + x0] * (1 - fx) + tile[z1 + y0 + x1] * fx) * (1 - fy) +
                 (tile[z1 + y1 + x0] * (1 - fx) + tile[z1 + y1 + x1] * fx) * fy;
  return vec3(a * (1 - fz) + b * fz);
}

}  // namespace windfall
