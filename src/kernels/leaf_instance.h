// What the simulation writes and the renderer reads for one leaf, attached, falling or on the ground.
#pragma once

#include <cstdint>

#include "kernels/math.h"

namespace windfall {

/// One leaf as it lies in an OpenGL buffer. Position is the petiole's end, world space, metres.
/// The leaf's own frame: +y from petiole to tip, +z out of the upper face, +x across; it is turned by `rotation`
/// (unit quaternion x, y, z, w) and scaled by `size` (blade length in metres).
struct LeafInstance {
  vec3 position;
  float size;
  vec4 rotation;
  std::uint32_t layer;  ///< layer of the leaf texture array
  std::uint32_t state;  ///< LeafState
  float curl;           ///< 0 flat and fresh .. 1 dry and curled
  float tint;           ///< -1..1, per-leaf variation of brightness and hue
};
static_assert(sizeof(LeafInstance) == 48);

enum class LeafState : std::uint32_t { Attached = 0, Falling = 1, Sliding = 2, Resting = 3, Hidden = 4 };

}  // namespace windfall
