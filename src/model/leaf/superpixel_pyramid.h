// Superpixels in levels, each made of those of the next finer one.
#pragma once

#include <vector>

#include "model/leaf/superpixels.h"

namespace windfall::model {

/// What is known of one superpixel; its place is the centre of its pixels.
struct SuperpixelPlace {
  SuperpixelMean mean;
  float x = 0, y = 0;  ///< px of the structure
  int parent = -1;     ///< in the next coarser level; -1 in the coarsest
};

/// From coarse to fine; the last level is the structure's own superpixels.
using SuperpixelPyramid = std::vector<std::vector<SuperpixelPlace>>;

/// `levels` of them: with up to three each has an eighth of the next, with more a quarter (leaf_textures.md, 6: 256,
/// 2048, 16384, or 64, 256, ... as in the thesis). The finest are clustered upwards by SLIC, so that parents are exact.
/// `lab`: three floats a pixel, may be null.
SuperpixelPyramid buildSuperpixelPyramid(const LeafStructure& structure, const float* lab, int levels);

/// The labels of one level of `levels`, 0 the coarsest; 1.. inside the leaf.
LabelField superpixelLevel(const LeafStructure& structure, int level, int levels);

}  // namespace windfall::model
