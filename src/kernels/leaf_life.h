// The rare moments of a leaf's life: coming loose, changing its motion, touching the ground, coming to rest, growing
// again.
#pragma once

#include <cmath>

#include "kernels/leaf_arrays.h"
#include "kernels/leaf_chain.h"
#include "kernels/leaf_hang.h"
#include "kernels/leaf_traits.h"

namespace windfall {

/// Seconds in which one stage passes into the next, and the hanging leaf into the falling one.
inline constexpr float kBlend = 0.25f, kReleaseBlend = 0.6f;
/// The ground is touched when the middle of the blade is this low, m.
inline constexpr float kTouch = 0.012f;
/// Time constant with which a leaf lies down, s, and how long it may.
inline constexpr float kLieDown = 0.15f, kLyingDown = 1.2f;
/// Of leaf on ground.
inline constexpr float kFriction = 0.5f;
/// How long a leaf takes to vanish from the ground, and to grow again, s.
inline constexpr float kVanish = 1.0f, kGrow = 3.0f;

template <class T>
WINDFALL_HD void addTo(T& total, T amount) {
#if defined(__CUDA_ARCH__)
  if constexpr (sizeof(T) == 8) {
    atomicAdd(reinterpret_cast<unsigned long long*>(&total), static_cast<unsigned long long>(amount));
  } else {
    atomicAdd(&total, amount);
  }
#else
  __atomic_fetch_add(&total, amount, __ATOMIC_RELAXED);
#endif
}

/// Chooses yaw and face of leaf i so that, with the motion's own turn `turn`, it is as near to how it shows now as can
/// be; what is left fades out. `spin`: turns since the stage began.
WINDFALL_HD std::uint32_t alignTo(const LeafArrays& a, std::uint32_t i, std::uint32_t meta, const vec4& shown,
                                  const vec4& turn, float spin, bool flat) {
  const vec4 upright = compose(compose(inverse(turn), shown), inverse(bladeTurn(false, flat)));
  const bool face = upright.x * upright.x + upright.z * upright.z > 0.5f;
  const vec4 rest = face ? compose(compose(inverse(turn), shown), inverse(bladeTurn(true, flat))) : upright;
  const float yaw = std::atan2(rest.y, rest.w) * (2.0f / kTwoPi);
  const vec4 offset = compose(shown, inverse(leafTurn(turn, yaw, face, flat)));
  a.yaw[i] = yaw - spin;
  a.offsetTurn[i] = packed(offset.w < 0.0f ? -offset : offset);
  return face ? meta | kFaceBit : meta & ~kFaceBit;
}

/// Velocity without the wind's part at a time of the stage.
WINDFALL_HD vec3 stageVelocity(const LeafArrays& a, std::uint32_t i, std::uint32_t meta, float clock) {
  const LeafTraits traits = traitsOf(a, i, meta);
  const vec3 motion = motionAt(motionOf(meta), traits, clock + a.phase[i]).velocity;
  const float ramp = (meta & kFreshBit) != 0 ? tanhOf(kGravity * clock / traits.speed) : 1.0f;
  const float fade = 1.0f - smoothStep(clock * (1.0f / kBlend));
  return ramp * motion + fade * vec3(a.offsetX[i], a.offsetY[i], a.offsetZ[i]);
}

/// Starts the next stage of leaf i with `motion`, `late` seconds ago, from the velocity (without wind) it had then and
/// the turn it has.
WINDFALL_HD void startStage(const LeafArrays& a, std::uint32_t i, const LeafStep& step, std::uint32_t meta,
                            std::uint32_t motion, float late, const vec3& velocity, const vec4& shown) {
  const std::uint32_t stage = ((meta >> kStageShift) + 1u) & 0xffffu;
  meta = (meta & (kStateMask | kFaceBit | kMirrorBit | kFreshBit)) | (motion << kMotionShift) | (stage << kStageShift);
  const LeafTraits traits = traitsOf(a, i, meta);
  const std::uint32_t draw = kDrawStage + 4u * stage;
  const float frequency = shapeOf(motion).frequency1 * traits.flutter;
  float length = 1.0f + 2.0f * uniform(step.seed, i, a.generation[i], draw);
  length = length > 1.5f / frequency ? length : 1.5f / frequency;
  float phase = uniform(step.seed, i, a.generation[i], draw + 1u) / frequency;
  if (motion == kTumbling) {
    // Whole half turns: it ends as flat as it began.
    phase = 0.0f;
    length = std::ceil(length * frequency) / frequency;
  }
  a.phase[i] = phase;
  a.length[i] = length;
  a.clock[i] = late;
  a.offsetX[i] = a.offsetY[i] = a.offsetZ[i] = 0.0f;
  const vec3 offset = velocity - stageVelocity(a, i, meta, 0.0f);
  const bool fresh = (meta & kFreshBit) != 0;
  a.offsetX[i] = fresh ? 0.0f : offset.x;
  a.offsetY[i] = fresh ? 0.0f : offset.y;
  a.offsetZ[i] = fresh ? 0.0f : offset.z;
  const float middle = late - 0.5f * step.dt;  // a step shows the turn of its middle
  const MotionSample sample = motionAt(motion, traits, middle + phase);
  a.meta[i] = alignTo(a, i, meta, shown, normalized(motionTurn(motion, traits, sample)),
                      yawRate(motion, traits) * middle, false);
}

/// Attached leaf i comes loose at the start of the step, with the velocity of its twig.
WINDFALL_HD void release(const LeafArrays& a, std::uint32_t i, const LeafStep& step) {
  const LinkState& link = step.links.previous[a.link[i]];
  const vec3 felt(a.driftX[i], a.driftY[i], a.driftZ[i]);
  const LeafPose pose = hangingPose(a, i, link.position, link.rotation, felt, hash(step.seed, i), step.flutterClock);
  const vec3 velocity = velocityAt(link, pose.middle - link.position);
  a.x[i] = pose.middle.x, a.y[i] = pose.middle.y, a.z[i] = pose.middle.z;
  a.turn[i] = packed(pose.turn);
  a.driftX[i] = velocity.x, a.driftY[i] = velocity.y, a.driftZ[i] = velocity.z;
  a.born[i] = step.time;
  const std::uint32_t meta = (a.meta[i] & kMirrorBit) | static_cast<std::uint32_t>(LeafState::Falling) | kFreshBit;
  const std::uint32_t motion = firstMotion(hash(step.seed, i, a.generation[i], kDrawStage));
  startStage(a, i, step, meta, motion, 0.0f, vec3(0), pose.turn);
  addTo(a.totals->attached, -1);
  addTo(a.totals->airborne, 1);
  addTo(a.lost[a.link[i]], 1);
}

/// Puts loose leaf i into the air, somewhere over the disc. Does not count it.
WINDFALL_HD void startLoose(const LeafArrays& a, std::uint32_t i, const LeafStep& step) {
  const std::uint32_t generation = a.generation[i];
  const SinCos bearing = sinCosTurns(uniform(step.seed, i, generation, kDrawPlace));
  const float radius = step.spawnRadius * std::sqrt(uniform(step.seed, i, generation, kDrawPlace + 1u));
  a.x[i] = a.nextX[i] = step.spawnCentre.x + radius * bearing.cos;
  a.y[i] = a.nextY[i] = step.spawnHeight;
  a.z[i] = a.nextZ[i] = step.spawnCentre.z + radius * bearing.sin;
  a.driftX[i] = a.driftY[i] = a.driftZ[i] = 0.0f;
  a.windX[i] = a.windY[i] = a.windZ[i] = 0.0f;
  a.born[i] = step.time;
  const std::uint32_t meta = (a.meta[i] & kMirrorBit) | static_cast<std::uint32_t>(LeafState::Falling) | kFreshBit;
  const vec4 shown = leafTurn({0, 0, 0, 1}, uniform(step.seed, i, generation, kDrawGround), false, false);
  a.turn[i] = a.nextTurn[i] = packed(shown);
  startStage(a, i, step, meta, firstMotion(hash(step.seed, i, generation, kDrawStage)), 0.0f, vec3(0), shown);
}

/// How leaf i lies on the ground: 5 to 15 degrees out of level, some way up; turn without yaw.
struct GroundPose {
  vec4 turn;
  float height;
};

WINDFALL_HD GroundPose groundPose(const LeafArrays& a, std::uint32_t i, const LeafStep& step) {
  const std::uint32_t generation = a.generation[i];
  const float tilt = (5.0f + 10.0f * uniform(step.seed, i, generation, kDrawGround + 1u)) / 360.0f;
  const SinCos axis = sinCosTurns(uniform(step.seed, i, generation, kDrawGround + 2u));
  return {turnAbout({axis.cos, 0, axis.sin}, tilt), 0.003f + 0.3f * a.size[i] * sinCosTurns(tilt).sin};
}

/// Falling leaf i went below the touching height in this step: puts it there and lets it slide on.
WINDFALL_HD void land(const LeafArrays& a, std::uint32_t i, const LeafStep& step) {
  const float fall = a.y[i] - a.nextY[i];
  const float part = fall > 1e-9f ? clampTo((a.y[i] - kTouch) / fall, 0.0f, 1.0f) : 0.0f;
  const float rest = (1.0f - part) * step.dt;
  const vec3 motion = stageVelocity(a, i, a.meta[i], a.clock[i] - rest);
  const float vx = 0.5f * (motion.x + a.driftX[i]), vz = 0.5f * (motion.z + a.driftZ[i]);
  a.nextX[i] = a.x[i] + (a.nextX[i] - a.x[i]) * part + vx * rest;
  a.nextZ[i] = a.z[i] + (a.nextZ[i] - a.z[i]) * part + vz * rest;
  a.nextY[i] = kTouch;
  a.driftX[i] = vx, a.driftY[i] = 0.0f, a.driftZ[i] = vz;
  a.clock[i] = rest;
  const std::uint32_t meta = (a.meta[i] & (kFaceBit | kMirrorBit)) | static_cast<std::uint32_t>(LeafState::Sliding);
  a.meta[i] = alignTo(a, i, meta, unpacked(a.nextTurn[i]), groundPose(a, i, step).turn, 0.0f, true);
  const float airborne = step.time + step.dt - rest - a.born[i];
  addTo(a.totals->airborne, -1);
  addTo(a.totals->grounded, 1);
  addTo(a.totals->landed, std::int64_t{1});
  addTo(a.totals->fallMicroseconds, static_cast<std::int64_t>(llround(static_cast<double>(airborne) * 1e6)));
}

/// Sliding leaf i: slows by friction and lies down; rests when it has done both.
WINDFALL_HD void slide(const LeafArrays& a, std::uint32_t i, const LeafStep& step) {
  const float speed = std::sqrt(a.driftX[i] * a.driftX[i] + a.driftZ[i] * a.driftZ[i]);
  const float loss = kFriction * kGravity * step.dt;
  const float slower = speed > loss ? speed - loss : 0.0f;
  // Distance by the mean speed while it moves; the last piece is v^2 / 2a.
  const float way = speed > loss ? 0.5f * (speed + slower) * step.dt : 0.5f * speed * speed / (kFriction * kGravity);
  const float along = speed > 0.0f ? way / speed : 0.0f, keep = speed > 0.0f ? slower / speed : 0.0f;
  const float clock = a.clock[i] + step.dt;
  const float left = expOf(-clock * (1.0f / kLieDown));
  const GroundPose ground = groundPose(a, i, step);
  const bool done = slower == 0.0f && clock > kLyingDown;
  const vec4 lying = leafTurn(ground.turn, a.yaw[i], (a.meta[i] & kFaceBit) != 0, true);
  a.nextX[i] = a.x[i] + a.driftX[i] * along;
  a.nextZ[i] = a.z[i] + a.driftZ[i] * along;
  a.nextY[i] = done ? ground.height : ground.height + (kTouch - ground.height) * left;
  a.nextTurn[i] = packed(done ? lying : normalized(compose(fading(unpacked(a.offsetTurn[i]), 1.0f - left), lying)));
  a.driftX[i] *= keep, a.driftZ[i] *= keep;
  a.clock[i] = clock;
  if (!done) return;
  a.x[i] = a.nextX[i], a.y[i] = a.nextY[i], a.z[i] = a.nextZ[i], a.turn[i] = a.nextTurn[i];
  a.meta[i] = (a.meta[i] & ~kStateMask) | static_cast<std::uint32_t>(LeafState::Resting);
  // Rests 15 to 40 s where leaves grow again.
  a.length[i] = step.time + 15.0f + 25.0f * uniform(step.seed, i, a.generation[i], kDrawRest);
}

/// Leaf i begins anew where it began, as another one.
WINDFALL_HD void growAgain(const LeafArrays& a, std::uint32_t i, const LeafStep& step) {
  a.generation[i] += 1u;
  a.meta[i] = drawTraits(a, i, step);
  addTo(a.totals->grounded, -1);
  if (a.link[i] == kLoose) {
    startLoose(a, i, step);
    addTo(a.totals->airborne, 1);
    return;
  }
  a.clock[i] = 0.0f;
  a.driftX[i] = a.driftY[i] = a.driftZ[i] = 0.0f;
  addTo(a.totals->attached, 1);
  addTo(a.lost[a.link[i]], -1);
}

}  // namespace windfall
