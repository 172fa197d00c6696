// Quaternions as plain vec4 (x, y, z, w) and rotation vectors, with the same bits on every instruction set.
#pragma once

#include <cmath>

#include "kernels/math.h"

namespace windfall {

/// The rotation "first b, then a".
WINDFALL_HD vec4 compose(const vec4& a, const vec4& b) {
  return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
          a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}

WINDFALL_HD vec4 inverse(const vec4& q) { return {-q.x, -q.y, -q.z, q.w}; }

/// One Newton step towards unit length: enough against rounding (tree_dynamics.md, 5.10).
WINDFALL_HD vec4 renormalise(const vec4& q) {
  const float n = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
  return q * (1.5f - 0.5f * n);
}

/// Largest angle that a joint shows, rad (tree_dynamics.md, 5.5).
inline constexpr float kLargestJointAngle = 1.5f;

/// Factor that brings a rotation vector to at most kLargestJointAngle. NaN gives 0.
WINDFALL_HD float clampAngle(const vec3& v) {
  const float square = v.x * v.x + v.y * v.y + v.z * v.z;
  if (square <= kLargestJointAngle * kLargestJointAngle) return 1;
  const float factor = kLargestJointAngle / std::sqrt(square);
  return factor <= 1 ? factor : 0;
}

/// Unit quaternion of a rotation vector of at most kLargestJointAngle; polynomials instead of sine and cosine, whose
/// bits differ between libraries. Error below 3e-8.
WINDFALL_HD vec4 exponential(const vec3& v) {
  const float y = 0.25f * (v.x * v.x + v.y * v.y + v.z * v.z);
  const float c = 1 + y * (-0.5f + y * (1.f / 24 + y * (-1.f / 720 + y * (1.f / 40320))));
  const float s = 0.5f * (1 + y * (-1.f / 6 + y * (1.f / 120 + y * (-1.f / 5040 + y * (1.f / 362880)))));
  return {v.x * s, v.y * s, v.z * s, c};
}

}  // namespace windfall
