// The six motions of a falling leaf in closed form (falling_leaves.md, 3.2) and the turn that goes with each (4).
#pragma once

#include <cmath>
#include <cstdint>

#include "kernels/elementary.h"
#include "kernels/math.h"
#include "kernels/quaternion.h"

namespace windfall {

inline constexpr float kGravity = 9.81f;
inline constexpr float kTwoPi = 6.28318530718f;

/// Steady descent, periodic tumbling, transitional chaotic, periodic fluttering, transitional helical, periodic
/// spiralling.
enum LeafMotion : std::uint32_t {
  kSteady = 0,
  kTumbling = 1,
  kChaotic = 2,
  kFluttering = 3,
  kHelical = 4,
  kSpiralling = 5
};
inline constexpr std::uint32_t kLeafMotions = 6;

/// A row of the table of 3.2: speeds as multiples of the terminal speed, frequencies as multiples of the flutter's.
struct MotionShape {
  float descent, radius1, frequency1, radius2, frequency2, drift, bob, bobFrequency;
  float spin;  ///< share of the orbit's frequency with which the leaf turns about its own normal
};

/// Turns a second of a fluttering leaf, times half chord over terminal speed.
inline constexpr float kFlutterRate = 0.067f;
/// Twice the tumbling rate of 0.7 * 1.2 V/a rad/s, in units of the flutter's frequency.
inline constexpr float kTumble = 2 * 0.84f / (kTwoPi * kFlutterRate);

/// Chooses one of six constants by masks: no gather from a table and no branch, so loops vectorise on any instruction
/// set.
class MotionChoice {
 public:
  WINDFALL_HD explicit MotionChoice(std::uint32_t motion)
      : b_(0u - static_cast<std::uint32_t>(motion == 1u)),
        c_(0u - static_cast<std::uint32_t>(motion == 2u)),
        d_(0u - static_cast<std::uint32_t>(motion == 3u)),
        e_(0u - static_cast<std::uint32_t>(motion == 4u)),
        f_(0u - static_cast<std::uint32_t>(motion == 5u)) {}
  WINDFALL_HD float operator()(float a, float b, float c, float d, float e, float f) const {
    const std::uint32_t base = bitsOf(a);
    return floatOf(base ^ (b_ & (base ^ bitsOf(b))) ^ (c_ & (base ^ bitsOf(c))) ^ (d_ & (base ^ bitsOf(d))) ^
                   (e_ & (base ^ bitsOf(e))) ^ (f_ & (base ^ bitsOf(f))));
  }

 private:
  std::uint32_t b_, c_, d_, e_, f_;
};

WINDFALL_HD MotionShape shapeOf(std::uint32_t motion) {
  const MotionChoice pick(motion);
  return {pick(1.00f, 0.80f, 0.90f, 0.75f, 0.85f, 0.95f),
          pick(0.03f, 0.20f, 0.35f, 0.60f, 0.48f, 0.55f),
          pick(0.35f, kTumble, 0.93f, 1.0f, 1.125f, 0.8f),
          pick(0.02f, 0.20f, 0.30f, 0.60f, 0.32f, 0.0f),
          pick(-0.27f, -kTumble, -1.37f, -1.0f, -0.875f, 0.0f),
          pick(0.0f, 0.9f, 0.15f, 0.0f, 0.0f, 0.0f),
          pick(0.02f, 0.35f, 0.35f, 0.60f, 0.20f, 0.03f),
          pick(0.5f, kTumble, 2.3f, 2.0f, 2.0f, 0.8f),
          pick(0.0f, 0.0f, 0.0f, 0.0f, 0.1f, 0.15f)};
}

/// What a leaf keeps while it falls.
struct LeafTraits {
  float speed;               ///< terminal speed V_t, m/s
  float flutter;             ///< flutter frequency, Hz
  float headingX, headingZ;  ///< unit: direction of the motion's own x axis in the world
  float chirality;           ///< 1 or -1
};

/// Velocity and acceleration of the motion at a time, and what the turn needs.
struct MotionSample {
  vec3 velocity;      ///< m/s
  vec3 acceleration;  ///< m/s2
  float tumbleTurns;  ///< angle of tumbling, turns
  float most;         ///< m/s2, bound of the horizontal acceleration
};

/// sin(x) / x for |x| < 2.
WINDFALL_HD float sinc(float x) {
  const float square = x * x;
  return 1.0f - square * (1.0f / 6) * (1.0f - square * (1.0f / 20) * (1.0f - square * (1.0f / 42)));
}

/// `time`: seconds since the stage began plus its phase. The velocity is the mean over `span` seconds about it, so that
/// steps of any length add up to the closed form.
WINDFALL_HD MotionSample motionAt(std::uint32_t motion, const LeafTraits& leaf, float time, float span = 0) {
  const MotionShape shape = shapeOf(motion);
  const float base = leaf.flutter * time;
  const float orbit = shape.frequency1 * base;
  const SinCos one = sinCosTurns(orbit), two = sinCosTurns(shape.frequency2 * base);
  const SinCos bob = sinCosTurns(shape.bobFrequency * base);
  const float omega = kTwoPi * leaf.flutter;
  const float half = 0.5f * omega * span;
  const float r1 = shape.radius1 * sinc(shape.frequency1 * half), r2 = shape.radius2 * sinc(shape.frequency2 * half);
  const float rise = shape.bob * sinc(shape.bobFrequency * half);
  const float x = r1 * one.cos + r2 * two.cos + shape.drift;
  const float z = leaf.chirality * (r1 * one.sin + r2 * two.sin);
  const float w1 = shape.frequency1 * shape.radius1 * omega, w2 = shape.frequency2 * shape.radius2 * omega;
  const float ax = -(w1 * one.sin + w2 * two.sin);
  const float az = leaf.chirality * (w1 * one.cos + w2 * two.cos);
  return {leaf.speed * vec3(leaf.headingX * x - leaf.headingZ * z, rise * bob.sin - shape.descent,
                            leaf.headingZ * x + leaf.headingX * z),
          leaf.speed * vec3(leaf.headingX * ax - leaf.headingZ * az, shape.bob * shape.bobFrequency * omega * bob.cos,
                            leaf.headingZ * ax + leaf.headingX * az),
          // The sine is the modulation of the turning rate by +-65 %.
          0.5f * orbit + (0.33f / kTwoPi) * one.sin,
          // The second frequency is never positive.
          leaf.speed * (w1 - w2)};
}

/// Along the blade's normal, not of unit length: acceleration plus gravity, held up and within 75 degrees. `most`: the
/// motion's largest horizontal acceleration, which keeps quick leaves from flicking over as they pass through
/// weightlessness.
WINDFALL_HD vec3 normalFor(const vec3& acceleration, float most) {
  const float lift = acceleration.y + kGravity;
  const float least = 0.26794919f * most;
  const float floor = least > 2.0f ? least : 2.0f;
  return {acceleration.x, lift > floor ? lift : floor, acceleration.z};
}

/// The motion's own turn, from "normal up, tip to -z" to the world, without the leaf's yaw; not of unit length, which
/// one division at the end mends.
WINDFALL_HD vec4 motionTurn(std::uint32_t motion, const LeafTraits& leaf, const MotionSample& sample) {
  const vec3 n = normalFor(sample.acceleration, sample.most);
  // The shortest turn from +y to n (falling_leaves.md, 4).
  const float up = n.y + std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
  const SinCos half = sinCosTurns(0.5f * sample.tumbleTurns);
  const bool tumbles = motion == kTumbling;
  return {tumbles ? -leaf.headingZ * half.sin : n.z, 0.0f, tumbles ? leaf.headingX * half.sin : -n.x,
          tumbles ? half.cos : up};
}

/// Turns a second about the blade's own normal. The heading doubles as the leaf's random number.
WINDFALL_HD float yawRate(std::uint32_t motion, const LeafTraits& leaf) {
  const MotionShape shape = shapeOf(motion);
  return 0.048f * leaf.headingZ + leaf.chirality * shape.spin * shape.frequency1 * leaf.flutter;
}

/// From the leaf's frame (LeafInstance) to "normal up, tip to -z"; `face` 1: the upper face is below. `flat`: on the
/// ground; in the air the blade hangs 15 degrees, as a petiole bends it.
WINDFALL_HD vec4 bladeTurn(bool face, bool flat) {
  // Turns about x by -90, 90, -75 and 105 degrees.
  const float x = flat ? (face ? 0.70710678f : -0.70710678f) : (face ? 0.79335334f : -0.60876143f);
  const float w = flat ? 0.70710678f : (face ? 0.60876143f : 0.79335334f);
  return {x, 0.0f, 0.0f, w};
}

/// Motion's turn, yaw (turns) and face together: leaf frame to world.
WINDFALL_HD vec4 leafTurn(const vec4& turn, float yawTurns, bool face, bool flat) {
  const SinCos half = sinCosTurns(0.5f * yawTurns);
  return compose(compose(turn, vec4(0.0f, half.sin, 0.0f, half.cos)), bladeTurn(face, flat));
}

}  // namespace windfall
