// A leaf's shape as triangles, in four levels of detail, and how they bend.
#pragma once

#include <QImage>
#include <QPointF>
#include <array>
#include <cstdint>
#include <vector>

#include "kernels/math.h"
#include "sim/result.h"

namespace windfall::model {

/// A point of the flat leaf. Lengths in leaf lengths: from the petiole's end (the origin) to the picture's upper
/// border.
struct LeafVertex {
  vec2 place{0};  ///< x to the right, y towards the tip
  float rib = 0;  ///< x from the midrib; the sign is the half of the blade
  vec2 uv{0};     ///< shares of the texture, top left (0, 0)
};

/// Triangles counter-clockwise seen from above (+z).
struct LeafMesh {
  std::vector<LeafVertex> vertices;
  std::vector<std::uint32_t> indices;
};

/// From the finest: contour with midrib and an inner row on either side; coarser contour with midrib; a hull of at most
/// eight corners, a texel larger than the leaf; the picture's rectangle.
inline constexpr std::size_t kLeafLevels = 4;
using LeafMeshes = std::array<LeafMesh, kLeafLevels>;

/// What a mesh is fitted to.
struct LeafMeshSource {
  QImage image;                 ///< RGBA8888, upright; alpha from one half is leaf
  QPointF pivot{0.5, 1};        ///< petiole's end, shares of the image
  std::vector<QPointF> midrib;  ///< from petiole to tip, shares of the image; empty: straight up from the pivot
};

/// Tolerances are S/256 and S/64 of the image's long side (leaf_textures.md, 10). Error: nothing opaque in the picture.
Result<LeafMeshes> fitLeafMeshes(const LeafMeshSource& source);

/// How a leaf is bent. Angles in radians.
struct LeafBend {
  float curvature = 0;     ///< of the midrib in its plane, radians a leaf length, above `stalk`; positive bends upwards
  float fold = 0;          ///< of each half about the midrib, at the midrib
  float roll = 0;          ///< further turn of each half up to `halfWidth`
  float stalk = 0;         ///< share of the length that is petiole and stays straight
  float halfWidth = 0.4f;  ///< leaf lengths
  float ripple = 0;        ///< height of waves at the margin, leaf lengths
};

/// Droop, fold, roll and ripple of a leaf of this dryness 0..1; `own` -1..1 makes leaves differ (leaf_textures.md, 10).
LeafBend bendOf(float dryness, float own, float stalk, float halfWidth);

struct BentPoint {
  vec3 position{0};  ///< leaf lengths; x across, y along the petiole, z out of the upper face
  vec3 normal{0, 0, 1};
};

/// The place of a point of the flat leaf on the bent one. Lengths along the midrib and across it are kept (without
/// ripples); leaf.glsl does the same.
BentPoint bend(const LeafVertex& vertex, const LeafBend& bend);

}  // namespace windfall::model
