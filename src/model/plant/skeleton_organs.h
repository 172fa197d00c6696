// What hangs on a skeleton besides its stems.
#pragma once

#include "model/plant/skeleton_geometry.h"

namespace windfall::model {

/// Leaf sites from the leaves of the graph, small bodies for its buds, and its obstacles.
void addOrgans(const PlantSkeleton& skeleton, PlantGeometry& geometry);

}  // namespace windfall::model
