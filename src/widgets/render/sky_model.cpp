#include "widgets/render/sky_model.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace windfall::render {

namespace {

constexpr float kPi = 3.14159265f;
constexpr float kGround = 6.36e6f, kTop = 6.42e6f;      // m from the earth's centre
constexpr float kAirHeight = 8000, kHazeHeight = 1200;  // scale heights, m
constexpr float kHazeForward = 0.76f;                   // Henyey-Greenstein's g
constexpr float kHigherOrders = 0.9f;                   // isotropic share that stands for multiple scattering
constexpr float kSunIrradiance = 20;
const vec3 kAir(5.8e-6f, 13.5e-6f, 33.1e-6f);  // 1/m at sea level
const vec3 kOzone(0.65e-6f, 1.88e-6f, 0.085e-6f);
constexpr float kHaze = 6e-6f;

struct Depths {
  float air = 0, haze = 0, ozone = 0;
};

float distanceToTop(const vec3& from, const vec3& direction) {
  const float b = glm::dot(from, direction), c = glm::dot(from, from) - kTop * kTop;
  return -b + std::sqrt(std::max(0.f, b * b - c));
}

void addDepth(Depths& depths, const vec3& at, float length) {
  const float height = std::max(0.f, glm::length(at) - kGround);
  depths.air += std::exp(-height / kAirHeight) * length;
  depths.haze += std::exp(-height / kHazeHeight) * length;
  depths.ozone += std::max(0.f, 1 - std::abs(height - 25000) / 15000) * length;
}

Depths depthsToTop(const vec3& from, const vec3& direction, int steps) {
  Depths depths;
  const float total = distanceToTop(from, direction);
  // Steps grow with the distance: most of the air is near.
  float begin = 0;
  for (int i = 0; i < steps; ++i) {
    const float share = static_cast<float>(i + 1) / static_cast<float>(steps), end = total * share * share;
    addDepth(depths, from + direction * ((begin + end) * 0.5f), end - begin);
    begin = end;
  }
  return depths;
}

vec3 transmittance(const Depths& d) {
  const vec3 depth = kAir * d.air + vec3(kHaze * 1.1f) * d.haze + kOzone * d.ozone;
  return {std::exp(-depth.x), std::exp(-depth.y), std::exp(-depth.z)};
}

vec3 skyRadiance(const vec3& direction, const vec3& toSun) {
  const vec3 eye(0, kGround + 50, 0);
  const float total = distanceToTop(eye, direction), mu = glm::dot(direction, toSun);
  const float isotropic = kHigherOrders / (4 * kPi);
  const float airPhase = 3 / (16 * kPi) * (1 + mu * mu) + isotropic;
  const float g = kHazeForward;
  const float hazePhase = (1 - g * g) / (4 * kPi * std::pow(std::max(1e-4f, 1 + g * g - 2 * g * mu), 1.5f)) + isotropic;
  Depths seen;
  vec3 light(0);
  float begin = 0;
  constexpr int steps = 16;
  for (int i = 0; i < steps; ++i) {
    const float share = static_cast<float>(i + 1) / steps, end = total * share * share;
    const float length = end - begin;
    const vec3 at = eye + direction * ((begin + end) * 0.5f);
    addDepth(seen, at, length);
    Depths all = depthsToTop(at, toSun, 5);
    all.air += seen.air;
    all.haze += seen.haze;
    all.ozone += seen.ozone;
    const float height = std::max(0.f, glm::length(at) - kGround);
    const vec3 scattered = kAir * (std::exp(-height / kAirHeight) * airPhase) +
                           vec3(kHaze) * (std::exp(-height / kHazeHeight) * hazePhase);
    light += scattered * transmittance(all) * length;
    begin = end;
  }
  return light * kSunIrradiance;
}

}  // namespace

SkyLight computeSky(const vec3& toSun, const vec3& groundAlbedo) {
  SkyLight sky;
  vec3 flat(toSun.x, 0, toSun.z);
  flat = glm::length(flat) > 1e-4f ? glm::normalize(flat) : vec3(0, 0, 1);
  const vec3 side(-flat.z, 0, flat.x);
  sky.sun = transmittance(depthsToTop(vec3(0, kGround + 50, 0), toSun, 24)) * kSunIrradiance *
            std::clamp(toSun.y * 20 + 0.5f, 0.f, 1.f);

  sky.table.reserve(static_cast<std::size_t>(SkyLight::kWidth) * SkyLight::kHeight);
  vec3 sum(0), sumAlong(0), sumUp(0);
  for (int row = 0; row < SkyLight::kHeight; ++row) {
    const float root = static_cast<float>(row) / (SkyLight::kHeight - 1), sine = root * root;
    const float cosine = std::sqrt(std::max(0.f, 1 - sine * sine));
    const float rowAngle = 2 * root / (SkyLight::kHeight - 1);  // change of the sine over this row
    for (int column = 0; column < SkyLight::kWidth; ++column) {
      const float half = static_cast<float>(column) / (SkyLight::kWidth - 1), azimuth = 2 * std::asin(half);
      const vec3 direction = (flat * std::cos(azimuth) + side * std::sin(azimuth)) * cosine + vec3(0, sine, 0);
      const vec3 radiance = skyRadiance(direction, toSun);
      sky.table.push_back(radiance);
      // Both halves of the azimuth; its step is 2 / sqrt(1 - half^2) times the column's, with the pole left out.
      const float columnAngle = 4 / std::sqrt(std::max(0.03f, 1 - half * half)) / (SkyLight::kWidth - 1);
      const vec3 part = radiance * (rowAngle * columnAngle);
      sum += part;
      sumUp += part * sine;
      sumAlong += part * (cosine * std::cos(azimuth));
    }
  }
  // What comes up from the ground: uniform over the lower half.
  const vec3 ground = groundAlbedo * (sky.sun * std::max(0.f, toSun.y) + sumUp) / kPi;
  sum += ground * (2 * kPi);
  sumUp -= ground * kPi;
  sky.ambient[0] = sum / (4 * kPi);
  sky.ambient[1] = sumAlong * flat.x / (2 * kPi);
  sky.ambient[2] = sumUp / (2 * kPi);
  sky.ambient[3] = sumAlong * flat.z / (2 * kPi);
  return sky;
}

}  // namespace windfall::render
