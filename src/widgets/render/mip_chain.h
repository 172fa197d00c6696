// Mip levels of cut-out pictures: filtered in linear light with premultiplied alpha, coverage kept.
#pragma once

#include <cstdint>
#include <vector>

#include "widgets/render/content.h"

namespace windfall::render {

/// One level, ready for an sRGB8_ALPHA8 texture: colours premultiplied in linear light, then encoded. Rows from the
/// top.
struct MipLevel {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;
  /// Mean of the squared alpha over the mean alpha, before it is scaled: 1 where every texel is either open or covered,
  /// less the more edges of a shape are finer than a texel.
  float decided = 1;
};

/// All levels down to 1x1 of `picture`, resampled to width x height first. With `keepCoverage` every level's alpha is
/// scaled so that as many texels pass 0.5 as in the first one: cut-out leaves do not thin out in the distance
/// (Castano 2010, Computing Alpha Mipmaps; leaf_textures.md, 10).
std::vector<MipLevel> mipChain(const Picture& picture, int width, int height, bool keepCoverage);

/// Share of texels whose alpha is at least half.
double coverage(const MipLevel& level);

}  // namespace windfall::render
