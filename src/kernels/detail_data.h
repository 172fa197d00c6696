// The adaptive mesh of a plant as the GPU reads it: rings, the runs between them, and chains (plant_meshing.md, 6.1 and
// 6.4). Layouts of std430, as in resources/shaders/detail.glsl.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "kernels/math.h"

namespace windfall {

/// Tolerances of chain resolutions: level 0 keeps every ring, level k >= 1 what 0.3 mm * 2^k needs (6.4).
inline constexpr std::uint32_t kDetailLevels = 12;
constexpr float detailTolerance(std::uint32_t level) {
  return level == 0 ? 0.0f : 3e-4f * static_cast<float>(1u << level);
}

/// A cross-section at rest, plant space, m.
struct DetailRing {
  vec3 position{0};
  float radius = 0;
  vec3 tangent{0, 1, 0};
  float v = 0;  ///< bark coordinate along
  vec3 normal{1, 0, 0};
  float slope = 0;         ///< change of the radius along the axis
  vec3 outwards{0};        ///< unit, away from the parent's axis; zero where no collar blends (4.1)
  float gap = 1;           ///< distance of the centre from the parent's surface, in lengths of the collar
  float reach = 0;         ///< radius in lengths of the collar; negative: height of root lobes, share of the radius
  float collar = 0;        ///< 0..1: how near the junction, for occlusion
  std::uint32_t link = 0;  ///< that moves it, of its tree
  std::uint32_t tint = 0xffffffffu;  ///< RGBA, 8 bits each, red lowest; alpha: how much is wood
};
static_assert(sizeof(DetailRing) == 80);

/// How a run bends: in the lowest two bits the least level along the axis where it is drawn large (0, 1, 2, 3 for 1, 2,
/// 4, 8 pieces), then 15 bits each for the speed of its cubic at either end, in chords, 0 to 4.
constexpr std::uint32_t detailShape(std::uint32_t axial, float speedA, float speedB) {
  const auto bits = [](float speed) {
    // NOLINTNEXTLINE(bugprone-incorrect-roundings): never negative, and constant expressions know no lround
    return static_cast<std::uint32_t>((speed < 0 ? 0 : speed > 3.999f ? 3.999f : speed) * 8192 + 0.5f);
  };
  return (axial & 3u) | bits(speedA) << 2 | bits(speedB) << 17;
}

/// A run from one ring to another that some resolutions of its chain draw.
struct DetailEntry {
  std::uint32_t ringA = 0, ringB = 0;
  std::uint32_t chain = 0;
  std::uint32_t shape = detailShape(0, 1, 1);
  float sag = 0;           ///< of the curve over its chord, m
  float from = 0, to = 0;  ///< drawn at tolerances from <= e < to, m
  float radius = 0;        ///< of the thicker ring, m
};
static_assert(sizeof(DetailEntry) == 32);

struct DetailChain {
  std::uint32_t middle = 0;  ///< ring that its sphere is centred on
  float radius = 0;          ///< m, of a sphere that holds the chain in every pose: links are rigid
  std::uint32_t firstEntry = 0, entryCount = 0;
};
static_assert(sizeof(DetailChain) == 16);

/// Of one plant, shared by all trees that show it.
struct DetailMesh {
  std::vector<DetailRing> rings;
  std::vector<DetailEntry> entries;  ///< chain by chain
  std::vector<DetailChain> chains;
  /// Make up for what is left out at each level's tolerance e (6.4): a radius r grows by this share times min(1, e/r),
  /// since what lost most is what is thin.
  std::array<float, kDetailLevels> widening{};
  std::uint32_t links = 0;  ///< links that rings name are below this
};

/// A ring in the world, as seen: what the vertex shader reads.
struct SkinnedRing {
  vec3 position{0};
  float radius = 0;  ///< widened to the outline of a circle
  vec3 tangent{0, 1, 0};
  float v = 0;
  vec3 normal{1, 0, 0};
  float slope = 0;
  vec3 outwards{0};
  float gap = 1;
  float level = 0;         ///< log2(sides / 3); its sides are 3 * 2^ceil(level)
  float reach = 0;         ///< as DetailRing's
  std::uint32_t link = 0;  ///< of all trees; the highest 8 bits: the bark's layer
  std::uint32_t tint = 0;
};
static_assert(sizeof(SkinnedRing) == 80);

/// An instance of a grid: indices of skinned rings, and how it bends between them.
struct DetailRun {
  std::uint32_t ringA = 0, ringB = 0;
  std::uint32_t shape = 0;
};
static_assert(sizeof(DetailRun) == 12);

}  // namespace windfall
