// Air velocity at a place: a small lattice of the mean wind and its large eddies, a scrolled tile of small ones, fans.
#pragma once

#include <cmath>
#include <cstdint>

#include "kernels/eddy_tile.h"
#include "kernels/elementary.h"
#include "kernels/math.h"

namespace windfall {

/// A fan at one moment: a round jet.
struct FanJet {
  vec3 position{0};     ///< m, middle of its outlet
  float speed = 0;      ///< m/s there
  vec3 axis{1, 0, 0};   ///< unit vector it blows along
  float radius = 0.5f;  ///< m of the outlet
  vec3 scroll{0};       ///< nodes by which the jet has carried its own eddies
  float slope = 0.2f;   ///< m of radius a metre of way
};
inline constexpr int kMostFans = 8;

/// A hand on one link: a force that the solver adds to its own loads.
struct LinkPull {
  std::uint32_t link = 0xffffffffu;  ///< none
  vec3 force{0};                     ///< N, world
  vec3 arm{0};                       ///< m from the joint, world
};

/// What acts on links and leaves from outside. A regular lattice of samples around the scene, x fastest, then y, then
/// z; outside it the nearest border value holds. The pointers lie in the memory of the device that uses them.
struct WindView {
  const vec4* velocity = nullptr;  ///< m/s; w: root mean square of the small eddies, m/s
  int nx = 0, ny = 0, nz = 0;
  vec3 origin{0};                ///< m, place of sample (0, 0, 0)
  vec3 perMetre{1};              ///< cells a metre
  const vec4* eddies = nullptr;  ///< kTileNodes nodes; null: none
  vec3 eddyScroll{0};            ///< nodes that the small eddies have come, less whole tiles
  float eddiesPerMetre = 2;      ///< nodes a metre
  int fanCount = 0;
  FanJet fans[kMostFans];
  LinkPull pull;
};

/// Velocity that a fan adds, m/s. Momentum is kept, so a jet that widens slows down (speed times radius is constant,
/// as in a round turbulent jet); the profile across is a Gaussian.
WINDFALL_HD vec3 jetAt(const FanJet& fan, const vec4* eddies, float perMetre, const vec3& place) {
  const vec3 d = place - fan.position;
  const float along = glm::dot(d, fan.axis);
  const float lead = 0.5f * fan.radius;  // it draws air in from just behind the outlet
  if (!(along > -lead)) return vec3(0);
  const float radius = fan.radius + fan.slope * (along > 0 ? along : 0);
  const vec3 aside = d - along * fan.axis;
  const float off = glm::dot(aside, aside) / (radius * radius);
  if (off > 6) return vec3(0);
  const float entry = along < 0 ? 1 + along / lead : 1;
  const float speed = fan.speed * (fan.radius / radius) * entry * expOf(-off);
  const vec3 flow = fan.axis + aside * (fan.slope / radius);
  if (eddies == nullptr) return speed * flow;
  const vec3 eddy = eddyAt(eddies, place * perMetre - fan.scroll);
  return speed * (flow * (1 + 0.22f * eddy.x) + 0.12f * vec3(eddy.y, eddy.z, eddy.x));
}

/// Small eddies of a root mean square, m/s.
WINDFALL_HD vec3 smallEddies(const WindView& wind, const vec3& place, float size) {
  const vec3 eddy = eddyAt(wind.eddies, place * wind.eddiesPerMetre - wind.eddyScroll);
  // Eddies cannot blow through the ground.
  const float height = place.y > 0 ? place.y : 0;
  return size * vec3(eddy.x, 0.6f * height / (height + 1) * eddy.y, eddy.z);
}

/// Velocity of the air, m/s.
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
  const vec4 node = a * (1 - fz) + b * fz;
  vec3 velocity(node);
  if (wind.eddies != nullptr && node.w > 0) velocity += smallEddies(wind, place, node.w);
  for (int i = 0; i < wind.fanCount; ++i) velocity += jetAt(wind.fans[i], wind.eddies, wind.eddiesPerMetre, place);
  return velocity;
}

}  // namespace windfall
