// The sun's depth map over a sphere of the scene.
#pragma once

#include "kernels/math.h"
#include "sim/result.h"
#include "widgets/render/gl_object.h"

namespace windfall::render {

/// Light's projection of a sphere (center, radius) along the sun, snapped to whole texels so that shadows do not crawl
/// when the sphere moves.
struct ShadowFit {
  mat4 toClip{1};     ///< world to the light's clip space, depth 0..1
  mat4 toTexture{1};  ///< world to uv and depth in 0..1
  float texel = 0;    ///< world size of a texel, m
};
ShadowFit fitShadow(const vec3& center, float radius, const vec3& toSun, int size);

/// A depth texture that compares on reading, and its framebuffer.
class ShadowMap {
 public:
  /// Keeps what it has where the size is the same.
  Status resize(int size);
  int size() const { return size_; }
  GLuint texture() const { return texture_.id(); }
  GLuint framebuffer() const { return framebuffer_.id(); }

 private:
  Texture texture_;
  Framebuffer framebuffer_;
  int size_ = 0;
};

}  // namespace windfall::render
