// The wind as a function of place: mean profile, large eddies and travelling fronts at one moment (tree_dynamics.md,
// 8).
#pragma once

#include <cmath>
#include <cstdint>

#include "kernels/eddy_tile.h"
#include "kernels/random.h"

namespace windfall {

inline constexpr float kRoughness = 0.03f;     ///< z0 of open grass, m
inline constexpr float kReferenceHeight = 10;  ///< m, where the mean speed is given
inline constexpr float kInStand = 2.5f;        ///< a of the profile inside a stand
/// The tile serves twice: 8 m a node for eddies of 128 to 16 m, half a metre for those of 8 to 1 m.
inline constexpr float kLargePerMetre = 1.f / 8, kSmallPerMetre = 2;
/// Root mean squares of both parts of a turbulence of 1, by Kolmogorov's u ~ size^(1/3) over eight octaves.
inline constexpr float kLargeShare = 0.9295f, kSmallShare = 0.3688f;

/// All that the wind depends on at one moment. What moves with time is integrated by the caller, so that a change of
/// speed does not make the field jump.
struct WindMoment {
  vec3 direction{1, 0, 0};     ///< horizontal unit vector it blows to
  float speed = 0;             ///< mean at 10 m, m/s
  float deviation = 0;         ///< standard deviation along the mean, m/s
  float calm = 1;              ///< factor of everything, 0 after the end
  float canopy = 0;            ///< m, height of the stand around; 0: open grass
  float gustStrength = 0;      ///< A
  float gustSpacing = 100;     ///< m between fronts
  double gustTravel = 0;       ///< m that the fronts have come
  const vec4* tile = nullptr;  ///< null: no turbulence
  vec3 scroll[2]{};            ///< nodes that two layers of large eddies have come, less whole tiles
  std::uint32_t seed = 1;
};

/// Speed over the friction velocity's, times von Karman's constant: ln((z - d) / z0), and inside a stand of height h
/// U(h) exp(-a (1 - z / h)). 0 at the ground.
WINDFALL_HD float rawProfile(float height, float canopy) {
  if (!(canopy > 0)) return height > kRoughness ? std::log(height / kRoughness) : 0;
  const float displaced = 0.7f * canopy, roughness = 0.1f * canopy;
  if (height > canopy) return std::log((height - displaced) / roughness);
  return height > 0 ? std::log((canopy - displaced) / roughness) * std::exp(-kInStand * (1 - height / canopy)) : 0;
}

/// Mean speed at a height over its value at 10 m.
WINDFALL_HD float windProfile(float height, float canopy = 0) {
  return rawProfile(height, canopy) / rawProfile(kReferenceHeight, canopy);
}

/// Front `travelled` metres after it passed: rises over half its width, fades over one and a half; its mean over the
/// spacing is width / spacing.
WINDFALL_HD float gustShape(float travelled, float width) {
  const float rise = 0.5f * width;
  float t = travelled < rise ? travelled / rise : 1 - (travelled - rise) / (1.5f * width);
  t = t > 0 ? t : 0;
  return t * t * (3 - 2 * t);
}

/// Factor of the mean wind by the fronts; its mean over time is 1.
WINDFALL_HD float gustFactor(const WindMoment& wind, const vec3& place) {
  if (!(wind.gustStrength > 0)) return 1;
  const double phase = (wind.gustTravel - static_cast<double>(glm::dot(place, wind.direction))) / wind.gustSpacing;
  const double front = std::floor(phase);
  const float width = 0.4f * wind.gustSpacing < 20 ? 0.4f * wind.gustSpacing : 20;
  const float travelled = static_cast<float>(phase - front) * wind.gustSpacing;
  const auto number = static_cast<std::uint32_t>(static_cast<std::int64_t>(front));
  const float strength = wind.gustStrength * (0.6f + 0.8f * uniform(wind.seed, number, 77u));
  const float factor = 1 + strength * gustShape(travelled, width) - wind.gustStrength * width / wind.gustSpacing;
  return factor > 0 ? factor : 0;
}

/// Large eddies, m/s: u' along the mean, 0.8 of it across, 0.5 of it up. Two layers of the tile drift apart while the
/// wind carries both, so that eddies form and fade.
WINDFALL_HD vec3 largeEddies(const WindMoment& wind, const vec3& place) {
  const vec3 p = place * kLargePerMetre;
  const vec3 first = eddyAt(wind.tile, p - wind.scroll[0]);
  const vec3 second = eddyAt(wind.tile, vec3(p.z, p.y, p.x) - wind.scroll[1]);
  const vec3 sum = (first + vec3(second.z, second.x, second.y)) * (0.70710678f * kLargeShare * wind.deviation);
  const vec3 across(-wind.direction.z, 0, wind.direction.x);
  // Eddies cannot blow through the ground.
  const float free = place.y > 0 ? place.y / (place.y + 1) : 0;
  return sum.x * wind.direction + 0.8f * sum.y * across + vec3(0, 0.5f * free * sum.z, 0);
}

/// Air velocity at a place above the ground y = 0 without its small eddies, m/s; w: their root mean square. `profile`
/// is windProfile at the place's height.
WINDFALL_HD vec4 windNode(const WindMoment& wind, const vec3& place, float profile) {
  const float mean = wind.speed * profile * gustFactor(wind, place);
  vec3 velocity = wind.direction * mean;
  float small = 0;
  if (wind.tile != nullptr && place.y > 0) {
    velocity += largeEddies(wind, place);
    small = kSmallShare * wind.deviation;
  }
  return wind.calm * vec4(velocity, small);
}

}  // namespace windfall
