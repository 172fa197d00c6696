// Which region of the example lends its colours to which region of the target.
#pragma once

#include <vector>

#include "kernels/random.h"
#include "model/leaf/stages.h"

namespace windfall::model {

/// A region in numbers that do not depend on the picture's size.
struct RegionShape {
  float low = 0, high = 0;  ///< 2nd and 98th percentile of the structural distance
  double area = 0;          ///< share of the leaf
};

/// Entry i belongs to region i + 1.
std::vector<RegionShape> describeRegions(const LeafStructure& structure);

/// 1 for equal regions: overlap of the distance ranges times exp(-ln^2(area ratio) / (2 0.6^2)) (leaf_textures.md, 5).
double similarity(const RegionShape& a, const RegionShape& b);

/// For each region of the target one of the best fifth (at least three) of the example's, drawn by `random`; 1.. .
std::vector<int> matchRegions(const LeafStructure& target, const LeafStructure& example, RandomSequence& random);

}  // namespace windfall::model
