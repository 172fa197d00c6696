// What distinguishes one leaf from the next, drawn from its index and generation (falling_leaves.md, 3.2 and 2).
#pragma once

#include <cmath>

#include "kernels/leaf_arrays.h"
#include "kernels/random.h"

namespace windfall {

/// Uses of a leaf's random numbers; each is the last counter of a hash.
enum LeafDraw : std::uint32_t {
  kDrawNormal = 0,  // to 3
  kDrawHeading = 4,
  kDrawMirror = 5,
  kDrawPlace = 6,   // and 7
  kDrawGround = 8,  // to 10
  kDrawRest = 11,
  kDrawTough = 12,  // to 15
  kDrawLook = 16,   // to 19
  kDrawRelease = 20,
  kDrawGust = 21,
  kDrawStage = 32,  // and on, 4 a stage
};

/// Nearly N(0, 1): the sum of four uniform numbers, so |value| < 3.47 and no function of the C library is needed.
WINDFALL_HD float bellCurve(std::uint64_t seed, std::uint32_t leaf, std::uint32_t generation, std::uint32_t draw) {
  float sum = -2.0f;
  for (std::uint32_t k = 0; k < 4; ++k) sum += uniform(seed, leaf, generation, draw + k);
  return sum * 1.7320508f;
}

WINDFALL_HD float clampTo(float value, float low, float high) {
  const float raised = value > low ? value : low;
  return raised < high ? raised : high;
}

/// Broadside terminal speed of a leaf of this mass per area (kg/m2), m/s: drag coefficient 1.17 of a disc, air 1.2
/// kg/m3.
WINDFALL_HD float terminalSpeed(float massPerArea) { return std::sqrt(2.0f * massPerArea * kGravity / (1.2f * 1.17f)); }

/// Petiole strength that half of all leaves exceed, N (tree_dynamics.md, 9): 2 N in summer (season 0), 5 mN at the end.
WINDFALL_HD float petioleStrength(float season) { return expOf((1.0f - season) * 0.69314718f + season * -5.2983174f); }

/// One-sided area of a blade from its length, m2: 30 cm2 at 8 cm.
WINDFALL_HD float bladeArea(float length) { return 0.47f * length * length; }

/// Draws speed, frequency and heading of a generation; returns the meta bits that go with them.
WINDFALL_HD std::uint32_t drawTraits(const LeafArrays& a, std::uint32_t i, const LeafStep& step) {
  const std::uint32_t generation = a.generation[i];
  const float spread = expOf(0.2f * bellCurve(step.seed, i, generation, kDrawNormal));
  const float speed = step.speed * clampTo(spread, 0.7f / 1.15f, 2.0f / 1.15f);
  const float chord = clampTo(0.875f * a.size[i], 0.03f, 0.14f);
  // Small, heavy leaves would tumble faster than any display shows.
  const float rate = speed / (0.5f * chord);
  const SinCos heading = sinCosTurns(uniform(step.seed, i, generation, kDrawHeading));
  a.speed[i] = speed;
  a.flutter[i] = kFlutterRate * (rate < 45.0f ? rate : 45.0f);
  a.headingX[i] = heading.cos;
  a.headingZ[i] = heading.sin;
  return (hash(step.seed, i, generation, kDrawMirror) & 1u) != 0 ? kMirrorBit : 0u;
}

}  // namespace windfall
