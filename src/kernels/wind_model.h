// The wind as a function of place: mean profile, turbulence and travelling fronts at one moment (tree_dynamics.md, 8).
#pragma once

#include <cmath>
#include <cstdint>

#include "kernels/noise.h"

namespace windfall {

inline constexpr int kWindOctaves = 5;
inline constexpr float kLargestEddy = 100;     ///< m, cell of the largest octave
inline constexpr float kRoughness = 0.03f;     ///< z0 of open grass, m
inline constexpr float kReferenceHeight = 10;  ///< m, where the mean speed is given

/// All that the wind depends on at one moment. What moves with time is integrated by the caller, so that a change of
/// speed does not make the field jump.
struct WindMoment {
  vec3 direction{1, 0, 0};      ///< horizontal unit vector it blows to
  float speed = 0;              ///< mean at 10 m, m/s
  float deviation = 0;          ///< standard deviation along the mean, m/s
  float calm = 1;               ///< factor of everything, 0 after the end
  float gustStrength = 0;       ///< A
  float gustSpacing = 100;      ///< m between fronts
  double gustTravel = 0;        ///< m that the fronts have come
  double drift[3] = {0, 0, 0};  ///< m that the eddies were carried
  double turnover = 0;          ///< m that an eddy of the deviation's speed has turned, twice
  std::uint32_t seed = 1;
};

/// Mean speed at a height over its value at 10 m, log profile (0 at the ground).
WINDFALL_HD float windProfile(float height) {
  if (!(height > kRoughness)) return 0;
  return std::log(height / kRoughness) / std::log(kReferenceHeight / kRoughness);
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

/// Turbulence at a place, m/s: u' along the mean, 0.8 of it across, 0.5 of it up; amplitudes by Kolmogorov's 1/3 law.
WINDFALL_HD vec3 turbulence(const WindMoment& wind, const vec3& place) {
  vec3 sum(0);
  float cell = kLargestEddy, amplitude = 1, energy = 0;
  for (std::uint32_t octave = 0; octave < kWindOctaves; ++octave) {
    const double scale = 1.0 / static_cast<double>(cell);
    const auto within = [&](float at, int axis) {
      const double cells = (static_cast<double>(at) - wind.drift[axis]) * scale;
      return static_cast<float>(cells - std::floor(cells * (1.0 / 4096)) * 4096);
    };
    const double turns = wind.turnover * static_cast<double>(amplitude) * scale;
    const vec4 p(within(place.x, 0), within(place.y, 1), within(place.z, 2),
                 static_cast<float>(turns - std::floor(turns * (1.0 / 4096)) * 4096));
    sum += amplitude * noise4(hash(wind.seed, octave, 1u), p + 0.37f * static_cast<float>(octave));
    energy += amplitude * amplitude;
    cell *= 0.5f;
    amplitude *= 0.7937005f;
  }
  sum *= wind.deviation / (kNoiseRms * std::sqrt(energy));
  const vec3 across(-wind.direction.z, 0, wind.direction.x);
  // Eddies cannot blow through the ground.
  const float free = place.y > 0 ? place.y / (place.y + 1) : 0;
  return sum.x * wind.direction + 0.8f * sum.y * across + vec3(0, 0.5f * free * sum.z, 0);
}

/// Air velocity at a place above the ground y = 0, m/s.
WINDFALL_HD vec3 windVelocity(const WindMoment& wind, const vec3& place) {
  const float mean = wind.speed * windProfile(place.y) * gustFactor(wind, place);
  return wind.calm * (wind.direction * mean + (place.y > 0 ? turbulence(wind, place) : vec3(0)));
}

}  // namespace windfall
