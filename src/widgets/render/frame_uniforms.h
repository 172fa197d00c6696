// The uniform block of resources/shaders/frame.glsl, and how a view fills it.
#pragma once

#include <array>

#include "kernels/math.h"
#include "widgets/render/shadow_map.h"
#include "widgets/render/sky_model.h"
#include "widgets/render/view.h"

namespace windfall::render {

/// Layout of std140; members as in frame.glsl.
struct FrameUniforms {
  static constexpr int kCanopies = 16;
  mat4 viewProjection, shadowMatrix;
  vec4 eye, toSun, sunColor;
  std::array<vec4, 4> ambient;
  vec4 forward, right, up, wind, viewport, accent, grass;
  std::array<vec4, 2 * kCanopies> canopies;
};
static_assert(sizeof(FrameUniforms) == 2 * 64 + 16 * (3 + 4 + 7 + 2 * FrameUniforms::kCanopies));

/// A tree's crown as an ellipsoid that keeps sky light from what is in and under it.
struct Canopy {
  vec3 center{0};
  float radius = 1, halfHeight = 1;  ///< m
};

/// Camera, light and shadow; canopies are added by the caller. Depth is reversed (1 near, 0 infinitely far) in 0..1.
FrameUniforms frameUniforms(const View& view, const SkyLight& sky, const ShadowFit& shadow);
void setCanopies(FrameUniforms& uniforms, const std::vector<Canopy>& canopies);

}  // namespace windfall::render
