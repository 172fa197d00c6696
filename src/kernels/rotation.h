// Quaternions as plain vec4 (x, y, z, w), with the same bits on every instruction set.
#pragma once

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

}  // namespace windfall
