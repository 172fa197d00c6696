// Which runs of an adaptive mesh are drawn, and how finely: the arithmetic of the compute shaders, for the CPU
// (plant_meshing.md, 6.2 to 6.5). Choices take multiplications, additions and comparisons only, in the same order as
// resources/shaders/detail_select.glsl, so that both choose alike to the bit.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "kernels/detail_data.h"

namespace windfall {

inline constexpr std::uint32_t kDetailRadial = 5, kDetailAxial = 4;  ///< 3, 6, 12, 24, 48 sides; 1, 2, 4, 8 pieces
inline constexpr std::uint32_t kDetailGrids = kDetailRadial * kDetailAxial;

/// From where levels are chosen.
struct DetailCamera {
  vec3 eye{0};
  float scale = 1000;  ///< px at 1 m, by the tolerance in px: a tolerance of e metres belongs to the distance e * scale
  /// Inward half-spaces x n + w >= 0 that the picture lies in; (0, 0, 0, 1) lets everything pass.
  std::array<vec4, 4> planes{vec4(0, 0, 0, 1), vec4(0, 0, 0, 1), vec4(0, 0, 0, 1), vec4(0, 0, 0, 1)};
  float parallel = 0;  ///< 1: parallel projection, where every distance counts as 1 m
};

namespace detail {

/// Relative error of 3 * 2^k sides: 1 - cos(pi / (3 * 2^k)).
inline constexpr float kSagitta[4] = {0.5f, 0.1339746f, 0.03407417f, 0.008555139f};
inline constexpr float kNearest = 0.05f;  ///< m
/// A run that bends stands off to one side all along, while the sides of a polygon stand off to both: it may by a third
/// of the tolerance.
inline constexpr float kBendSeen = 3;

WINDFALL_HD float square(vec3 v) { return (v.x * v.x + v.y * v.y) + v.z * v.z; }

WINDFALL_HD vec3 moved(const mat4& m, vec3 p) {
  return (vec3(m[0]) * p.x + vec3(m[1]) * p.y) + (vec3(m[2]) * p.z + vec3(m[3]));
}

WINDFALL_HD vec3 turned(const mat4& m, vec3 d) { return (vec3(m[0]) * d.x + vec3(m[1]) * d.y) + vec3(m[2]) * d.z; }

WINDFALL_HD float side(vec4 plane, vec3 p) { return ((plane.x * p.x + plane.y * p.y) + plane.z * p.z) + plane.w; }

/// Squared distance that counts, m2.
WINDFALL_HD float distance2(const DetailCamera& camera, vec3 position) {
  if (camera.parallel > 0) return 1;
  return std::max(square(position - camera.eye), kNearest * kNearest);
}

/// Is the tolerance at a sphere's nearest point at least `e` (m)?
WINDFALL_HD bool reaches(const DetailCamera& camera, float centre2, float radius, float e) {
  const float far = e * camera.scale;
  if (camera.parallel > 0) return far <= 1;
  if (far <= kNearest) return true;
  const float from = far + radius;
  return from * from <= centre2;
}

/// 0 to 4: sides are 3 * 2^level.
WINDFALL_HD std::uint32_t radialLevel(float radius, float distance2, float scale) {
  const float seen = radius * scale;
  std::uint32_t level = 0;
  for (const float sagitta : kSagitta) {
    const float needed = sagitta * seen;
    level += needed * needed > distance2 ? 1 : 0;
  }
  return level;
}

/// 0 to 3: pieces are 2^level.
WINDFALL_HD std::uint32_t axialLevel(const DetailEntry& entry, float distance2, float scale) {
  const float seen = kBendSeen * (entry.sag * scale), seen2 = seen * seen;
  std::uint32_t level =
      (seen2 > distance2 ? 1 : 0) + (seen2 > 16 * distance2 ? 1 : 0) + (seen2 > 256 * distance2 ? 1 : 0);
  const float large = entry.radius * scale * 0.125f;
  if (large * large > distance2) level = std::max(level, entry.shape & 3u);
  return level;
}

/// Continuous level of a ring between `level - 1` and `level`, so that its vertices slide and never jump (6.3).
inline float smoothLevel(float radius, float distance, float scale, std::uint32_t level) {
  if (level == 0) return 0;
  const float x = std::min(distance / std::max(radius * scale, 1e-9f), 1.0f);
  const float sides = 3.14159265f / std::acos(1 - x), top = static_cast<float>(level);
  return std::clamp(std::log2(sides / 3), top - 0.9999f, top);
}

/// How far the odd vertices have slid on to the even ones: 0 not, 1 wholly.
inline float slide(float level) {
  const float rest = std::ceil(level) - level;
  return rest * rest * rest * rest;
}

/// Factor that gives a polygon of `sides` the mean outline of a circle (3.3).
inline float outlineFactor(float sides) {
  const float half = 3.14159265f / sides;
  return half / std::sin(half);
}

/// Factor on a radius for what a tolerance of `e` metres leaves out. A level is drawn from its own tolerance up to the
/// next one: the table counts at the middle between.
inline float widening(const std::array<float, kDetailLevels>& table, float e, float radius) {
  const float share = std::min(1.0f, e / std::max(radius, 1e-9f));
  float below = 0;
  e *= 0.75f;
  for (std::uint32_t k = 1; k < kDetailLevels; ++k) {
    const float above = detailTolerance(k);
    if (e < above) return 1 + share * (table[k - 1] + (table[k] - table[k - 1]) * (e - below) / (above - below));
    below = above;
  }
  return 1 + share * table[kDetailLevels - 1];
}

/// How much of a collar shows (0..1) where its length in px is `seen` times the tolerance: what blends a branch into
/// its parent ends before the rings at the collar's end are left out, or it would smear over the whole run.
inline float collarShown(float seen) {
  const float t = std::clamp(seen / 6 - 1, 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

/// Less light in the notch of a junction; the share of wood stays.
inline std::uint32_t shadedTint(std::uint32_t tint, float shade) {
  std::uint32_t out = tint & 0xff000000u;
  for (std::uint32_t shift = 0; shift < 24; shift += 8) {
    const float channel = static_cast<float>((tint >> shift) & 255u) * (1 - 0.35f * shade);
    // NOLINTNEXTLINE(bugprone-incorrect-roundings): as the shader does
    out |= static_cast<std::uint32_t>(channel + 0.5f) << shift;
  }
  return out;
}

WINDFALL_HD bool outside(const DetailCamera& camera, vec3 centre, float radius) {
  bool out = false;
  for (const vec4& plane : camera.planes) out = out || side(plane, centre) < -radius;
  return out;
}

WINDFALL_HD bool outside(const DetailCamera& camera, vec3 a, vec3 b, float margin) {
  bool out = false;
  for (const vec4& plane : camera.planes) out = out || (side(plane, a) < -margin && side(plane, b) < -margin);
  return out;
}

/// Of a run between rings that stand at `a` and `b`, with unwidened radii: the grid to draw, -1: out of sight.
WINDFALL_HD int gridOf(const DetailCamera& camera, const DetailEntry& entry, vec3 a, float radiusA, vec3 b,
                       float radiusB) {
  if (outside(camera, a, b, entry.radius * 1.5f + entry.sag * 2)) return -1;
  const float a2 = distance2(camera, a), b2 = distance2(camera, b);
  const std::uint32_t radial = std::max(radialLevel(radiusA, a2, camera.scale), radialLevel(radiusB, b2, camera.scale));
  return static_cast<int>(radial * kDetailAxial + axialLevel(entry, std::min(a2, b2), camera.scale));
}

}  // namespace detail

/// The ring as the vertex shader reads it. `firstLink` carries the bark's layer in its highest 8 bits.
inline SkinnedRing skinRing(const DetailRing& ring, const mat4& bone, std::uint32_t firstLink,
                            const std::array<float, kDetailLevels>& table, const DetailCamera& camera) {
  SkinnedRing out;
  out.position = detail::moved(bone, ring.position);
  const float d2 = detail::distance2(camera, out.position), d = std::sqrt(d2);
  const std::uint32_t level = detail::radialLevel(ring.radius, d2, camera.scale);
  out.level = detail::smoothLevel(ring.radius, d, camera.scale, level);
  const float sides = 3 * std::exp2(std::ceil(out.level) - detail::slide(out.level));
  out.radius = ring.radius * detail::outlineFactor(sides) * detail::widening(table, d / camera.scale, ring.radius);
  out.tangent = detail::turned(bone, ring.tangent);
  out.v = ring.v;
  out.normal = detail::turned(bone, ring.normal);
  out.slope = ring.slope;
  out.outwards = detail::turned(bone, ring.outwards);
  const float shown = ring.reach > 0 ? detail::collarShown(ring.radius / ring.reach * camera.scale / d) : 0;
  out.gap = ring.gap + (1 - shown) * (1 + std::abs(ring.reach));
  out.reach = ring.reach;
  out.link = firstLink + ring.link;
  out.tint = ring.collar > 0 ? detail::shadedTint(ring.tint, ring.collar * shown) : ring.tint;
  return out;
}

}  // namespace windfall
