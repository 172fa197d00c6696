// Where every link of the scene is and how it moves: what the tree solver hands to falling leaves and to the display.
#pragma once

#include <cstdint>

#include "kernels/math.h"

namespace windfall {

/// A link in the world at the end of a step. SI units.
struct LinkState {
  vec4 rotation{0, 0, 0, 1};  ///< unit quaternion x, y, z, w; link frame to world
  vec3 position{0};           ///< m, the joint (the link's start)
  float spare0 = 0;
  vec3 velocity{0};  ///< m/s, of the joint
  float spare1 = 0;
  vec3 angularVelocity{0};  ///< rad/s, world axes
  float spare2 = 0;
};
static_assert(sizeof(LinkState) == 64);

/// All links of all trees, in the scene's order, at the end of the last step and of the one before. The pointers lie in
/// the memory of the device that uses them; after a reset both show the rest pose.
struct LinkView {
  const LinkState* previous = nullptr;
  const LinkState* current = nullptr;
  std::uint32_t count = 0;
};

/// v turned by the unit quaternion q (x, y, z, w).
WINDFALL_HD vec3 rotate(const vec4& q, const vec3& v) {
  const vec3 axis(q.x, q.y, q.z);
  const vec3 t = 2.0f * glm::cross(axis, v);
  return v + q.w * t + glm::cross(axis, t);
}

/// v turned back by the unit quaternion q.
WINDFALL_HD vec3 rotateBack(const vec4& q, const vec3& v) { return rotate(vec4(-q.x, -q.y, -q.z, q.w), v); }

/// World place of a point of a link's own frame.
WINDFALL_HD vec3 placeOf(const LinkState& link, const vec3& local) {
  return link.position + rotate(link.rotation, local);
}

/// World velocity of a point of a link, given relative to the joint in world axes.
WINDFALL_HD vec3 velocityAt(const LinkState& link, const vec3& arm) {
  return link.velocity + glm::cross(link.angularVelocity, arm);
}

}  // namespace windfall
