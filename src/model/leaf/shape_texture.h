// The shape of a leaf's picture, without its maps.
#pragma once

#include "model/leaf/atlas.h"

namespace windfall::model {

/// Fits the meshes, the stalk and the half width of a texture to its picture. Error: nothing in it is opaque.
Status shapeTexture(LeafTexture& texture);

}  // namespace windfall::model
