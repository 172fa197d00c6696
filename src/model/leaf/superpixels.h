// Superpixels of structural distance, and what is known of each.
#pragma once

#include <vector>

#include "model/leaf/stages.h"

namespace windfall::model {

/// SLIC on the scalar distance inside the leaf: about `count` superpixels, labels 1.. that cover it
/// (leaf_textures.md, 6). Fewer come out when the leaf has too few pixels.
LabelField makeSuperpixels(const ScalarField& distance, const LabelField& regions, int count);

/// Means over a superpixel.
struct SuperpixelMean {
  float distance = 0, veinDistance = 0;
  float lab[3] = {0, 0, 0};
  int region = 0;  ///< the commonest of its pixels
  int area = 0;    ///< px
};

/// Entry i belongs to label i + 1. `lab`: three floats a pixel, may be null.
std::vector<SuperpixelMean> describeSuperpixels(const LeafStructure& structure, const float* lab);

}  // namespace windfall::model
