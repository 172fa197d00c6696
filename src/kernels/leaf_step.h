// One step of one leaf, in the pieces that the host's loops take and as the whole that a device thread runs.
#pragma once

#include "kernels/leaf_arrays.h"
#include "kernels/leaf_life.h"

namespace windfall {

/// Every `interval` steps: attached leaves may let go, falling ones look at the wind, resting ones may grow again.
WINDFALL_HD void lookAround(const LeafArrays& a, std::uint32_t i, const LeafStep& step) {
  switch (stateOf(a.meta[i])) {
    case LeafState::Attached:
      if (releases(a, i, step)) release(a, i, step);
      return;
    case LeafState::Falling: {
      const vec3 wind = windAt(step.wind, {a.x[i], a.y[i], a.z[i]});
      a.windX[i] = wind.x, a.windY[i] = wind.y, a.windZ[i] = wind.z;
      // A gust throws the leaf into tumbling or chaos; without it long falls would all end as spirals (5.2).
      const std::uint32_t motion = motionOf(a.meta[i]);
      if ((a.meta[i] & kFreshBit) != 0 || motion == kTumbling || motion == kChaotic) return;
      const vec3 gust = wind - vec3(a.driftX[i], a.driftY[i], a.driftZ[i]);
      const float strength = std::sqrt(gust.x * gust.x + gust.y * gust.y + gust.z * gust.z) / (2.0f * a.speed[i]);
      const float chance = 1.0f - expOf(-4.0f * strength * static_cast<float>(step.interval) * step.dt);
      if (uniform(hash(step.seed ^ kDrawGust, i, a.generation[i] ^ 0x80000000u, step.number)) < chance) {
        a.length[i] = 0.0f;
        a.meta[i] |= kGustBit;
      }
      return;
    }
    case LeafState::Resting:
      if (step.respawn && step.time >= a.length[i]) growAgain(a, i, step);
      return;
    default:
      return;
  }
}

/// Attached leaf: feels the wind, grows. Falling leaf: moves to the end of the step. Others: stay as they are.
/// True when something rare is due. Free of branches and with an index that cannot wrap, so that a loop over it
/// vectorises.
WINDFALL_HD bool moveLeaf(const LeafArrays& a, std::size_t i, const LeafStep& step) {
  const std::uint32_t meta = a.meta[i];
  const std::uint32_t state = meta & kStateMask;
  const bool falls = state == static_cast<std::uint32_t>(LeafState::Falling);
  const bool alive = falls || state == static_cast<std::uint32_t>(LeafState::Attached);
  const std::uint32_t motion = motionOf(meta);
  const LeafTraits leaf = traitsOf(a, i, meta);
  const float dt = step.dt, feltDecay = step.feltDecay;

  // The wind's part of the velocity: exact for constant wind over the step (falling_leaves.md, 6). Vertically, the
  // linearised quadratic drag is twice as stiff.
  const float relaxation = leaf.speed * (1.0f / kGravity);
  const float rate = 1.0f / relaxation;
  const float decay = expOf(-dt * rate);
  const float decayH = falls ? decay : feltDecay, decayV = falls ? decay * decay : feltDecay;
  const float windX = a.windX[i], windY = a.windY[i], windZ = a.windZ[i];
  const float driftX = a.driftX[i], driftY = a.driftY[i], driftZ = a.driftZ[i];
  const float lagX = driftX - windX, lagY = a.driftY[i] - windY, lagZ = a.driftZ[i] - windZ;
  const float reach = relaxation * (1.0f - decayH), reachV = 0.5f * relaxation * (1.0f - decayV);

  const float clock = a.clock[i], length = a.length[i];
  const float middle = clock + 0.5f * dt;
  const bool fresh = (meta & kFreshBit) != 0;
  const MotionSample sample = motionAt(motion, leaf, middle + a.phase[i], dt);
  const float slow = tanhOf(middle * rate);
  const float ramp = fresh ? slow : 1.0f;
  const float fade = 1.0f - smoothStep(middle * (1.0f / kBlend));
  const float x = a.x[i], y = a.y[i], z = a.z[i];
  const float newX = x + (ramp * sample.velocity.x + fade * a.offsetX[i] + windX) * dt + lagX * reach;
  const float newY = y + (ramp * sample.velocity.y + fade * a.offsetY[i] + windY) * dt + lagY * reachV;
  const float newZ = z + (ramp * sample.velocity.z + fade * a.offsetZ[i] + windZ) * dt + lagZ * reach;

  const vec4 target = leafTurn(motionTurn(motion, leaf, sample), a.yaw[i] + yawRate(motion, leaf) * middle,
                               (meta & kFaceBit) != 0, false);
  const float settled = smoothStep(middle * (fresh ? 1.0f / kReleaseBlend : 1.0f / kBlend));
  const std::uint32_t turn = packed(normalized(compose(fading(unpacked(a.offsetTurn[i]), settled), target)));

  const float newClock = clock + dt;
  a.nextX[i] = falls ? newX : x;
  a.nextY[i] = falls ? newY : y;
  a.nextZ[i] = falls ? newZ : z;
  const std::uint32_t oldTurn = a.turn[i];
  const std::uint32_t mask = 0u - static_cast<std::uint32_t>(falls);  // a choice would become a branch round the load
  a.nextTurn[i] = (turn & mask) | (oldTurn & ~mask);
  a.driftX[i] = alive ? windX + lagX * decayH : driftX;
  a.driftY[i] = alive ? windY + lagY * decayV : driftY;
  a.driftZ[i] = alive ? windZ + lagZ * decayH : driftZ;
  a.clock[i] = alive ? newClock : clock;
  const bool over = newClock >= length;
  const bool down = newY <= kTouch;
  return falls & (over | down);
}

/// The part of moveLeaf() that matters where nothing falls.
WINDFALL_HD void hangLeaf(const LeafArrays& a, std::size_t i, const LeafStep& step) {
  const bool hangs = (a.meta[i] & kStateMask) == static_cast<std::uint32_t>(LeafState::Attached);
  const float felt = step.feltDecay, dt = step.dt;
  const float x = a.driftX[i], y = a.driftY[i], z = a.driftZ[i];
  const float windX = a.windX[i], windY = a.windY[i], windZ = a.windZ[i];
  a.driftX[i] = hangs ? windX + (x - windX) * felt : x;
  a.driftY[i] = hangs ? windY + (y - windY) * felt : y;
  a.driftZ[i] = hangs ? windZ + (z - windZ) * felt : z;
  const float clock = a.clock[i];
  a.clock[i] = hangs ? clock + dt : clock;
}

/// A falling leaf has reached the ground or the end of its stage, at the end of the step.
WINDFALL_HD void turnPage(const LeafArrays& a, std::uint32_t i, const LeafStep& step) {
  if (a.nextY[i] <= kTouch) {
    land(a, i, step);
    return;
  }
  const std::uint32_t meta = a.meta[i];
  const bool gust = (meta & kGustBit) != 0;
  const std::uint32_t random = hash(step.seed, i, a.generation[i], kDrawStage + 4u * (meta >> kStageShift) + 2u);
  const std::uint32_t motion = gust ? ((random & 1u) != 0 ? kTumbling : kChaotic) : nextMotion(motionOf(meta), random);
  const float late = gust ? 0.0f : a.clock[i] - a.length[i], end = a.clock[i] - late;
  const vec3 overrun = stageVelocity(a, i, meta, end + 0.5f * late);
  startStage(a, i, step, meta & ~(kFreshBit | kGustBit), motion, late, stageVelocity(a, i, meta, end),
             unpacked(a.nextTurn[i]));
  // The step went on with the old motion for `late` seconds too long.
  const vec3 amends = late * (stageVelocity(a, i, a.meta[i], 0.5f * late) - overrun);
  a.nextX[i] += amends.x, a.nextY[i] += amends.y, a.nextZ[i] += amends.z;
}

/// The whole step of leaf i, as one thread of a device runs it.
WINDFALL_HD void stepLeaf(const LeafArrays& a, std::uint32_t i, const LeafStep& step, std::uint32_t block) {
  if ((i / block + step.number) % step.interval == 0) lookAround(a, i, step);
  const LeafState state = stateOf(a.meta[i]);
  if (state == LeafState::Attached) {
    hangLeaf(a, i, step);
  } else if (state == LeafState::Falling) {
    if (moveLeaf(a, i, step)) turnPage(a, i, step);
  } else if (state == LeafState::Sliding) {
    slide(a, i, step);
  }
}

}  // namespace windfall
