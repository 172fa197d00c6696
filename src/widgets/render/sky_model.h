// The sky's light on a clear day for a place of the sun, computed once when the sun moves.
#pragma once

#include <array>
#include <vector>

#include "kernels/math.h"

namespace windfall::render {

/// Radiance in units in which the sun above the air gives an irradiance of 20.
struct SkyLight {
  static constexpr int kWidth = 64, kHeight = 64;
  /// Radiance; column: sine of half the azimuth from the sun, row: square root of the sine of the elevation.
  std::vector<vec3> table;
  vec3 sun{0};  ///< irradiance of the sun at the ground, on a surface that faces it
  /// Diffuse light over pi for a surface with normal n: ambient[0] + n.x ambient[1] + n.y ambient[2] + n.z ambient[3],
  /// from the sky above and from the lit ground below (spherical harmonics to the first order).
  std::array<vec3, 4> ambient{};
};

/// Single scattering by air, ozone and haze with a share of isotropic light for the higher orders
/// (Nishita et al. 1993, Display of the Earth; coefficients of Bruneton & Neyret 2008).
/// `toSun` is a unit vector, Y up; `groundAlbedo` colours the light from below.
SkyLight computeSky(const vec3& toSun, const vec3& groundAlbedo);

}  // namespace windfall::render
