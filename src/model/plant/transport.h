// Frames that do not twist along a curve (plant_meshing.md, 2.2).
#pragma once

#include "kernels/math.h"

namespace windfall::model {

/// Hanson and Ma 1995: turns normal `n0` as tangent t0 turns into t1. Unit vectors.
template <class V>
V rotatedAlong(V t0, V t1, V n0);

/// Double reflection (Wang, Juttler, Zheng, Liu 2008): carries normal `n0` from point x0 with unit tangent t0 to x1
/// with t1; fourth order in the step. The result is unit and normal to t1.
template <class V>
V carriedAlong(V x0, V t0, V n0, V x1, V t1);

/// A normal to start from: the world's Z turned by `yaw` radians about the vertical, X where the tangent runs along it.
vec3 startNormal(vec3 tangent, float yaw);

extern template vec3 rotatedAlong(vec3, vec3, vec3);
extern template vec3 carriedAlong(vec3, vec3, vec3, vec3, vec3);
extern template glm::dvec3 rotatedAlong(glm::dvec3, glm::dvec3, glm::dvec3);
extern template glm::dvec3 carriedAlong(glm::dvec3, glm::dvec3, glm::dvec3, glm::dvec3, glm::dvec3);

}  // namespace windfall::model
