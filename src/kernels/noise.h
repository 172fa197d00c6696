// Gradient noise in four dimensions, three components at once (tree_dynamics.md, 8): space and time without repeats.
#pragma once

#include <cmath>
#include <cstdint>

#include "kernels/math.h"
#include "kernels/random.h"

namespace windfall {

/// Root mean square of each component of `noise4`, measured (tests/unit/kernels/noise.cpp).
inline constexpr float kNoiseRms = 0.3382f;

/// +1 or -1 by one bit of a hash.
WINDFALL_HD float signOf(std::uint32_t bits, std::uint32_t bit) {
  return static_cast<float>(1 - 2 * static_cast<std::int32_t>((bits >> bit) & 1u));
}

/// Three decorrelated components, mean 0, at p = (x, y, z, t) in cells. Zero at the lattice's points.
WINDFALL_HD vec3 noise4(std::uint32_t seed, const vec4& p) {
  const float fx = std::floor(p.x), fy = std::floor(p.y), fz = std::floor(p.z), fw = std::floor(p.w);
  const vec4 f(p.x - fx, p.y - fy, p.z - fz, p.w - fw);
  const vec4 s = f * f * f * (f * (f * 6.0f - 15.0f) + 10.0f);
  const auto cell = [](float v) { return static_cast<std::uint32_t>(static_cast<std::int64_t>(v)); };
  const std::uint32_t ix = cell(fx), iy = cell(fy), iz = cell(fz), iw = cell(fw);
  const float wx[2] = {1 - s.x, s.x}, wy[2] = {1 - s.y, s.y}, wz[2] = {1 - s.z, s.z}, ww[2] = {1 - s.w, s.w};
  vec3 sum(0);
  for (std::uint32_t corner = 0; corner < 16; ++corner) {
    const std::uint32_t dx = corner & 1u, dy = (corner >> 1u) & 1u, dz = (corner >> 2u) & 1u, dw = corner >> 3u;
    const std::uint32_t h = pcg((ix + dx) * 0x8da6b343u ^ (iy + dy) * 0xd8163841u ^ (iz + dz) * 0xcb1ab31fu ^
                                (iw + dw) * 0x165667b1u ^ seed);
    const float x = f.x - static_cast<float>(dx), y = f.y - static_cast<float>(dy);
    const float z = f.z - static_cast<float>(dz), w = f.w - static_cast<float>(dw);
    const float weight = wx[dx] * wy[dy] * wz[dz] * ww[dw];
    // The gradients are the corners (+-1, +-1, +-1, +-1); bits 8 and on are the best mixed.
    sum.x += weight * (signOf(h, 8) * x + signOf(h, 9) * y + signOf(h, 10) * z + signOf(h, 11) * w);
    sum.y += weight * (signOf(h, 14) * x + signOf(h, 15) * y + signOf(h, 16) * z + signOf(h, 17) * w);
    sum.z += weight * (signOf(h, 20) * x + signOf(h, 21) * y + signOf(h, 22) * z + signOf(h, 23) * w);
  }
  return sum;
}

}  // namespace windfall
