// Air velocity at a place and a time, from a small lattice of samples that is refreshed each step.
#pragma once

#include <cstdint>

#include "kernels/math.h"

namespace windfall {

/// A regular lattice of air velocities around the scene, x fastest, then y, then z. The pointer lies in the memory of
/// the device that uses it. Outside, the nearest border value holds.
struct WindView {
  const vec4* velocity = nullptr;  ///< m/s; w unused
  int nx = 0, ny = 0, nz = 0;
  vec3 origin{0};    ///< m, place of sample (0, 0, 0)
  vec3 perMetre{1};  ///< cells a metre
};

/// Trilinear sample, m/s.
WINDFALL_HD vec3 windAt(const WindView& wind, vec3 place) {
  if (wind.velocity == nullptr) return vec3(0);
  const vec3 p = (place - wind.origin) * wind.perMetre;
  const vec3 last(static_cast<float>(wind.nx - 1), static_cast<float>(wind.ny - 1), static_cast<float>(wind.nz - 1));
  // Comparisons written so that NaN ends at 0.
  const float x = p.x > 0 ? (p.x < last.x ? p.x : last.x) : 0;
  const float y = p.y > 0 ? (p.y < last.y ? p.y : last.y) : 0;
  const float z = p.z > 0 ? (p.z < last.z ? p.z : last.z) : 0;
  const int ix = static_cast<int>(x), iy = static_cast<int>(y), iz = static_cast<int>(z);
  const int dx = ix + 1 < wind.nx ? 1 : 0;
  const int dy = iy + 1 < wind.ny ? wind.nx : 0;
  const int dz = iz + 1 < wind.nz ? wind.nx * wind.ny : 0;
  const float fx = x - static_cast<float>(ix), fy = y - static_cast<float>(iy), fz = z - static_cast<float>(iz);
  const vec4* s = wind.velocity + (static_cast<std::int64_t>(iz) * wind.ny + iy) * wind.nx + ix;
  const vec4 a = (s[0] * (1 - fx) + s[dx] * fx) * (1 - fy) + (s[dy] * (1 - fx) + s[dy + dx] * fx) * fy;
  const vec4 b = (s[dz] * (1 - fx) + s[dz + dx] * fx) * (1 - fy) + (s[dz + dy] * (1 - fx) + s[dz + dy + dx] * fx) * fy;
  return vec3(a * (1 - fz) + b * fz);
}

}  // namespace windfall
