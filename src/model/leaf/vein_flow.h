// How much of a leaf each of its veins serves.
#pragma once

#include <vector>

#include "model/leaf/stages.h"

namespace windfall::model {

/// For each pixel the share of the leaf, 0..1, whose shortest way to the root passes here or beside: near 1 at the foot
/// of the midrib, small at the end of a lateral. It tells veins of equal standing apart however wide they were drawn.
/// Ways are the steepest falls of the structural distance (leaf_textures.md, 3: geodesic voting, on any veins).
std::vector<float> veinFlow(const LeafStructure& structure);

}  // namespace windfall::model
