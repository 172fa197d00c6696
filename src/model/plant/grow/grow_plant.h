// A grown skeleton as a plant: bones, skin, bark and leaves.
#pragma once

#include <QString>

#include "model/plant/geometry.h"
#include "model/plant/grow/grow_skeleton.h"

namespace windfall::model::growth {

/// Grows a plant by space colonization, self-organization or rules, applies the hand edits, and dresses it. Bones are
/// the skeleton's links in the order of its axes. The same settings give the same bits.
Result<PlantGeometry> growPlant(const Plant& plant, Progress& progress, WoodMesh wood = WoodMesh::Whole);

/// The geometry of a finished skeleton.
PlantGeometry dress(const Grown& grown, const GrowerSettings& settings);

}  // namespace windfall::model::growth
