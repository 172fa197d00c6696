// Structural distance: how far a place is from the root along the veins and across the tissue.
#pragma once

#include <QImage>
#include <QPoint>
#include <cstdint>
#include <vector>

#include "model/leaf/leaf.h"
#include "model/leaf/stages.h"

namespace windfall::model {

/// What a pixel is.
enum class Tissue : std::uint8_t { Outside = 0, Blade = 1, Vein = 2 };

/// Exact least cost from `source` in steps to eight neighbours, ten a straight step and fourteen a diagonal one times
/// the cost of the step's kind; Dial's bucket queue, O(pixels + largest distance). -1 where there is no way
/// (leaf_textures.md, 4).
std::vector<std::int32_t> structuralDistance(const std::vector<Tissue>& types, QSize size, QPoint source,
                                             const DistanceCosts& costs);

/// Divides by the 99.5th percentile; 0 outside, places without a way count as farthest.
ScalarField normalised(const std::vector<std::int32_t>& distance, QSize size, const std::vector<Tissue>& types);

/// Distance to the nearest vein in pixels over twice its 95th percentile; 0 outside.
ScalarField veinDistanceField(const std::vector<Tissue>& types, QSize size);

}  // namespace windfall::model
