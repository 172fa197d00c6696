// How a leaf's picture keeps covering what the leaf covers where its alpha is no shape any more.
#pragma once

#include <array>
#include <vector>

#include "kernels/math.h"
#include "widgets/render/content.h"
#include "widgets/render/mip_chain.h"

namespace windfall::render {

/// Levels of a picture that have a factor of their own; coarser ones take the last.
inline constexpr std::size_t kCoverLevels = 12;

struct LeafCover {
  /// Levels of the picture between which alpha stops being a shape, by the share of texels that edges cut.
  float from = 16, to = 17;
  /// What alpha, taken as a share, is multiplied by so that a shape (component) of kLeafLevels covers the leaf's area:
  /// a blurred picture reaches beyond a shape that was cut close round the leaf.
  std::array<vec4, kCoverLevels> factors{};
};

/// Of a layer from its picture's levels; `shapes` as drawn.
LeafCover coverOf(const std::vector<MipLevel>& levels, const std::array<LeafShape, kLeafLevels>& shapes);

/// Mean of a map's four numbers over the leaf, 0..1; `plain` where there is no map.
vec4 meanOver(const Picture& map, const Picture& leaf, const vec4& plain);

}  // namespace windfall::render
