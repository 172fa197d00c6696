// Vertices of a skinned mesh that no bone holds.
#pragma once

#include <cstdint>
#include <vector>

#include "model/plant/geometry.h"

namespace windfall::model {

/// Gives each of the `loose` vertices the bones and weights of the nearest vertex that is not among them, so that they
/// do not stay behind when the branch sways that they lie on. Nothing where all are loose.
void holdLooseVertices(PlantGeometry& geometry, const std::vector<std::uint32_t>& loose);

}  // namespace windfall::model
