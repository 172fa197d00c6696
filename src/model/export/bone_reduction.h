// Fewer bones for tools that take few (plant_meshing.md, 7).
#pragma once

#include "model/plant/clip.h"
#include "model/plant/geometry.h"

namespace windfall::model {

struct BoneLimits {
  int count = 0;  ///< at most so many bones, 0: as many as there are
  int depth = 0;  ///< at most so many from the root to a tip, 0: no limit
};

/// Merges consecutive bones of a branch where that bends it least (Douglas and Peucker), then folds the shortest
/// branches into the bones that carry them. Vertices, leaf sites and clips follow; unweighted bones go.
void reduceBones(PlantGeometry& geometry, std::vector<Clip>& clips, const BoneLimits& limits);

}  // namespace windfall::model
