// The textures that a leaf gives to atlases and trees.
#pragma once

#include <vector>

#include "model/leaf/atlas.h"
#include "model/leaf/leaf.h"
#include "model/leaf/stages.h"
#include "model/progress.h"
#include "sim/result.h"

namespace windfall::model {

/// The leaf's veins in the pixels of a variant of this size; `stages` up to the veins.
Veins variantVeins(const LeafStages& stages, QSize variant);

/// The kept variants that have a picture, upright, with maps and meshes, named "Oak 001" and so on; empty where none
/// is kept. The leaf's root and tip are found as the image pane shows them.
Result<std::vector<LeafTexture>> keptTextures(const Leaf& leaf, Progress& progress);

}  // namespace windfall::model
