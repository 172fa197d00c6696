// What lies under the pointer: a ray against the links of the trees as they stand now.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "kernels/math.h"
#include "sim/tree.h"
#include "widgets/viewport/orbit_camera.h"

namespace windfall::widgets {

/// A link as a capsule in its tree's rest space; the pose matrix of the same index takes it to the world.
struct LinkCapsule {
  vec3 from{0}, to{0};
  float radius = 0;
};
std::vector<LinkCapsule> capsulesOf(const sim::Tree& tree);

struct Hit {
  std::size_t link = 0;  ///< index into the capsules
  float distance = 0;    ///< along the ray, m
};

/// The link that the ray meets first. Thin twigs count as `slack` radians wide seen from the ray's origin, so that they
/// can be clicked at all; a link that is really met wins over one that is only near.
std::optional<Hit> pick(const Ray& ray, std::span<const LinkCapsule> capsules, std::span<const mat4> pose, float slack);

/// Where the ray meets the horizontal plane at `height`; nothing if it never does within a kilometre.
std::optional<vec3> meetGround(const Ray& ray, float height);

/// The box around posed links; nothing without any.
std::optional<Box> boundsOf(std::span<const LinkCapsule> capsules, std::span<const mat4> pose);

}  // namespace windfall::widgets
