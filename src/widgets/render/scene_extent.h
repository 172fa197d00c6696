// Where the scene is: what the shadow map must cover, and the crowns that keep light out.
#pragma once

#include <vector>

#include "kernels/math.h"
#include "widgets/render/frame_uniforms.h"
#include "widgets/render/renderer.h"
#include "widgets/render/tree_pass.h"

namespace windfall::render {

/// Follows the frames that are published. Reads one matrix a tree and a few leaves, never the whole slot.
class SceneExtent {
 public:
  void reset() { *this = SceneExtent(); }
  void update(const TreePass& trees, const FrameSlot& slot);
  /// Sphere around trees and the leaves near them; grows in steps and never shrinks, so that shadows keep still.
  vec3 center() const { return center_; }
  float radius() const { return radius_; }
  const std::vector<Canopy>& canopies() const { return canopies_; }

 private:
  Bounds bounds_;
  vec3 center_{0, 2, 0};
  float radius_ = 4;
  std::vector<Canopy> canopies_;
};

}  // namespace windfall::render
