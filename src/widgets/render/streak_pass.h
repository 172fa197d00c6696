// Draws threads of air over the scene, hidden by what stands before them.
#pragma once

#include <vector>

#include "kernels/math.h"
#include "sim/result.h"
#include "widgets/render/gl_object.h"

namespace windfall::render {

class StreakPass {
 public:
  Status compile();
  /// `points`: world place and opacity, `perStreak` of each streak from its head to its end. Draw calls made. The
  /// frame's uniforms are bound by the caller; blending is left off afterwards.
  int draw(const std::vector<vec4>& points, int perStreak);

 private:
  Program program_;
  Buffer points_;
  std::size_t capacity_ = 0;
};

}  // namespace windfall::render
