// The frame of a bone or link: +z along it (tree_dynamics.md, 1).
#pragma once

#include "kernels/math.h"

namespace windfall::model {

/// Rotation from the frame of a link that points along `direction` (any length) to plant space; +x stays as level as it
/// can. Identity for no direction.
quat alongZ(vec3 direction);

/// Rotation from the leaf's frame (LeafInstance: +y to the tip, +z out of the upper face) to plant space. `tip` is the
/// direction of the blade; `up` is turned as close to the upper face's normal as it can be.
quat leafRotation(vec3 tip, vec3 up);

/// Closest point of the segment a-b as a share 0..1 of it.
float closestShare(vec3 a, vec3 b, vec3 point);

}  // namespace windfall::model
