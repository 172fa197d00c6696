// A leaf on its twig: how it hangs and flutters, and when its petiole lets go (tree_dynamics.md, 9).
#pragma once

#include <cmath>

#include "kernels/leaf_arrays.h"
#include "kernels/leaf_traits.h"
#include "kernels/quaternion.h"
#include "kernels/random.h"

namespace windfall {

/// Turn of an attached leaf: at rest on its site, bent downwind and trembling with the wind it feels.
/// `site`: leaf frame to world at rest; `clock`: time modulo kFlutterPeriod, s.
WINDFALL_HD vec4 hangingTurn(const vec4& site, const vec3& felt, std::uint32_t leafHash, float clock) {
  const float speed = std::sqrt(felt.x * felt.x + felt.y * felt.y + felt.z * felt.z);
  const vec3 tip = rotate(site, vec3(0, 1, 0));
  const float bend = 0.35f * speed / (speed * speed + 60.0f);
  const vec3 axis = (bend * glm::cross(tip, felt));
  const vec4 bent = compose(normalized({axis.x, axis.y, axis.z, 1.0f}), site);
  // 1.5 to 4 Hz and the next notes, in whole cycles a period.
  const float base = static_cast<float>(96u + (leafHash & 127u)) * (1.0f / kFlutterPeriod);
  const float start = uniform(leafHash * 0x9e3779b9u);
  const float amplitude =
      0.045f * speed / (speed + 4.0f) * (0.6f + static_cast<float>((leafHash >> 8u) & 255u) / 255.0f);
  const float nod = sinCosTurns(base * clock + start).sin + 0.5f * sinCosTurns(2.0f * base * clock + 3.0f * start).sin;
  const float roll = sinCosTurns(base * clock + start + 0.3f).sin + 0.4f * sinCosTurns(3.0f * base * clock).sin;
  return compose(bent, compose(turnAbout({1, 0, 0}, amplitude * nod), turnAbout({0, 1, 0}, 1.3f * amplitude * roll)));
}

/// Middle of the blade and turn of an attached leaf.
struct LeafPose {
  vec3 middle;
  vec4 turn;
};

WINDFALL_HD vec3 siteOf(const LeafArrays& a, std::uint32_t i) { return {a.siteX[i], a.siteY[i], a.siteZ[i]}; }

WINDFALL_HD LeafPose hangingPose(const LeafArrays& a, std::uint32_t i, const vec3& joint, const vec4& linkTurn,
                                 const vec3& felt, std::uint32_t leafHash, float clock) {
  const vec4 turn = hangingTurn(compose(linkTurn, a.siteTurn[i]), felt, leafHash, clock);
  return {joint + rotate(linkTurn, siteOf(a, i)) + rotate(turn, vec3(0, 0.5f * a.size[i], 0)), turn};
}

/// Force on the petiole, N, of a blade of `area` m2 in an air flow relative to it (m/s), accelerated with its twig.
WINDFALL_HD float petioleLoad(float area, const vec3& flow, const vec3& acceleration) {
  const float square = flow.x * flow.x + flow.y * flow.y + flow.z * flow.z;
  const float drag = 0.5f * 1.2f * 0.3f * area * std::sqrt(square) / std::sqrt(1.0f + square / 25.0f);
  const float mass = 0.18f * area;  // fresh
  const vec3 force = drag * flow + mass * (vec3(0, -kGravity, 0) - acceleration);
  return std::sqrt(force.x * force.x + force.y * force.y + force.z * force.z);
}

/// Chance that a petiole under `load` parts within `time`: hazard of 1/s (load / strength)^4, and none below 0.15 of
/// the strength, where the power law alone would leave half an hour: a green tree keeps its leaves through any storm.
WINDFALL_HD float releaseChance(float load, float strength, float time) {
  const float square = load / strength * (load / strength);
  const float hazard = square > 0.0225f ? square * square : 0.0f;
  return 1.0f - expOf(-hazard * time);
}

/// Looks at the wind and decides whether attached leaf i lets go at the start of the step.
WINDFALL_HD bool releases(const LeafArrays& a, std::uint32_t i, const LeafStep& step) {
  const LinkState& before = step.links.previous[a.link[i]];
  const LinkState& now = step.links.current[a.link[i]];
  const vec3 arm = rotate(before.rotation, siteOf(a, i));
  const vec3 velocity = velocityAt(before, arm);
  const vec3 acceleration = (velocityAt(now, rotate(now.rotation, siteOf(a, i))) - velocity) / step.dt;
  const vec3 wind = windAt(step.wind, before.position + arm);
  a.windX[i] = wind.x, a.windY[i] = wind.y, a.windZ[i] = wind.z;
  // A leaf that still grows holds.
  if (a.clock[i] < 3.0f) return false;
  const float load = petioleLoad(bladeArea(a.size[i]), wind - velocity, acceleration);
  const float chance = releaseChance(load, step.strength * a.toughness[i], static_cast<float>(step.interval) * step.dt);
  return uniform(hash(step.seed, i, a.generation[i] ^ 0x40000000u, step.number)) < chance;
}

}  // namespace windfall
