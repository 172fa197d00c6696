// The built-in grower: trunk, limbs and twigs by rule.
#pragma once

#include "model/plant/geometry.h"
#include "model/plant/plant.h"
#include "model/progress.h"
#include "sim/result.h"

namespace windfall::model {

/// A tree of `settings.height` with tapered, gently curved axes at the golden angle, bound to its skeleton, with bark
/// and leaf sites. The same settings give the same bits. An error for settings that make no tree.
Result<PlantGeometry> grow(const GrowerSettings& settings, Progress& progress, WoodMesh wood = WoodMesh::Whole);

}  // namespace windfall::model
