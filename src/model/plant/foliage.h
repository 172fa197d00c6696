// Finding the leaves in an imported mesh.
#pragma once

#include "model/plant/geometry.h"

namespace windfall::model {

/// Marks the leaf materials: by name, by a texture with holes, or because their mesh falls into many small pieces.
void detectFoliage(PlantGeometry& geometry);

/// Turns the small connected pieces of leaf materials into leaf sites of the nearest bone and hides their mesh; larger
/// pieces stay visible.
void extractLeaves(PlantGeometry& geometry);

}  // namespace windfall::model
