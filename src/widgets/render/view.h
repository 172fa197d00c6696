// From where a scene is seen, and in which light.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "kernels/math.h"

namespace windfall::render {

/// What a frame may cost. Standard is meant for live views on any machine, High for pictures that are kept.
enum class Quality { Draft, Standard, High };

struct View {
  vec3 eye{0, 4, 16}, target{0, 4, 0};  ///< m, world
  float fieldOfView = 0.7f;             ///< radians, vertical
  int width = 1280, height = 720;       ///< px of the framebuffer
  vec3 toSun{0.5f, 0.6f, 0.6f};         ///< direction; need not be a unit vector
  float sunStrength = 1;
  float exposure = 0;                      ///< stops; 0 suits a clear day
  float time = 0;                          ///< s, for clouds and grass
  vec3 wind{0};                            ///< m/s, for clouds and grass
  float season = 0;                        ///< 0 summer .. 1 end of autumn: leaves turn
  std::vector<vec4> streaks;               ///< threads of air: place and opacity, the newest point of each first
  int streakPoints = 0;                    ///< of each thread
  std::vector<std::uint32_t> highlighted;  ///< links of all trees, in the bone buffer's order
  /// Of each link instead of its bark, 0xAABBGGRR in sRGB, alpha 0: bark; the bone buffer's order. Empty: bark for all.
  std::vector<std::uint32_t> linkColors;
  Quality quality = Quality::Standard;
  /// Shades one pixel in four; edges keep the picture's own resolution. For what must be seen soon, or moves.
  bool coarse = false;
  bool adaptive = true;     ///< trees that have an adaptive mesh are drawn with it, else with their whole mesh
  float tolerance = 0.5f;   ///< px that an adaptive mesh may be off; High halves it
  float cardsBelow = 1.5f;  ///< px of a leaf's length below which cards stand for clusters; 0: never, as in a coarse
                            ///< view; High halves it

  /// Of half the field of view.
  float tangent() const { return std::tan(std::clamp(fieldOfView, 0.02f, 2.8f) * 0.5f); }
  /// Px that a metre at a distance of one metre spans.
  float pixelsPerRadian() const { return static_cast<float>(height) / (2 * tangent()); }
};

}  // namespace windfall::render
