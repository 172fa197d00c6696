// What the renderer sees of a leaf between two steps.
#pragma once

#include "kernels/leaf_arrays.h"
#include "kernels/leaf_hang.h"
#include "kernels/leaf_life.h"
#include "kernels/leaf_look.h"

namespace windfall {

/// Where between the last two steps the display stands.
struct LeafDisplay {
  std::uint64_t seed = 1;
  float alpha = 1;         ///< 0: before the last step, 1: after it
  float time = 0;          ///< s, shown
  float flutterClock = 0;  ///< time modulo kFlutterPeriod
  float feltDecay = 1;     ///< of the last step
  float season = 0;
  bool respawn = false;
  LinkView links;
};

/// Leaf i as it shows; `a` between two steps.
WINDFALL_HD LeafInstance showLeaf(const LeafArrays& a, std::uint32_t i, const LeafDisplay& display) {
  const std::uint32_t meta = a.meta[i];
  const LeafState state = stateOf(meta);
  const std::uint32_t look = hash(display.seed, i);
  LeafPose pose;
  float scale = 1;
  if (state == LeafState::Attached) {
    const LinkState& before = display.links.previous[a.link[i]];
    const LinkState& now = display.links.current[a.link[i]];
    // What it felt before the step follows from what it feels after it.
    const vec3 wind(a.windX[i], a.windY[i], a.windZ[i]);
    const vec3 lag = vec3(a.driftX[i], a.driftY[i], a.driftZ[i]) - wind;
    const vec3 felt = wind + lag * (1.0f + (1.0f - display.alpha) * (1.0f / display.feltDecay - 1.0f));
    pose = hangingPose(a, i, glm::mix(before.position, now.position, display.alpha),
                       interpolated(before.rotation, now.rotation, display.alpha), felt, look, display.flutterClock);
    scale = smoothStep(a.clock[i] * (1.0f / kGrow));
  } else {
    pose.middle = glm::mix(vec3(a.nextX[i], a.nextY[i], a.nextZ[i]), vec3(a.x[i], a.y[i], a.z[i]), display.alpha);
    pose.turn = interpolated(unpacked(a.nextTurn[i]), unpacked(a.turn[i]), display.alpha);
    if (display.respawn && state == LeafState::Resting) scale = smoothStep((a.length[i] - display.time) / kVanish);
    if (a.link[i] == kLoose && a.generation[i] > 0 && state == LeafState::Falling) {
      scale = smoothStep((display.time - a.born[i]) * 2.0f);
    }
  }
  LeafInstance leaf;
  leaf.size = a.size[i] * scale;
  // A growing blade grows from its petiole's end.
  const float half = state == LeafState::Attached ? 0.5f * a.size[i] : 0.5f * leaf.size;
  leaf.position = pose.middle - rotate(pose.turn, vec3(0, half, 0));
  leaf.rotation = pose.turn;
  leaf.layer = a.layer[i];
  leaf.state = static_cast<std::uint32_t>(state);
  leaf.curl = leafCurl(leafOwn(look), display.season);
  leaf.tint = leafTint(look);
  return leaf;
}

}  // namespace windfall
