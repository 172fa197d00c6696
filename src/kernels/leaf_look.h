// What makes one leaf look unlike its neighbour: bits drawn from its number alone.
#pragma once

#include <cstdint>

#include "kernels/leaf_traits.h"

namespace windfall {

/// Variation of brightness and hue, -1..1, from a leaf's hash.
WINDFALL_HD float leafTint(std::uint32_t look) { return static_cast<float>((look >> 8u) & 255u) / 127.5f - 1.0f; }
/// Its own share of dryness, 0..1.
WINDFALL_HD float leafOwn(std::uint32_t look) { return static_cast<float>((look >> 16u) & 255u) / 255.0f; }

/// LeafInstance::curl at a season.
WINDFALL_HD float leafCurl(float own, float season) {
  return clampTo(0.1f + 0.5f * season * season + 0.3f * (own - 0.5f), 0.0f, 1.0f);
}

}  // namespace windfall
