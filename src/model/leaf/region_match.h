// Which region of the example lends its colours to which region of the target.
#pragma once

#include <vector>

#include "kernels/random.h"
#include "model/leaf/stages.h"

namespace windfall::model {

/// A region in numbers.
struct RegionShape {
  float low = 0, high = 0;        ///< 2nd and 98th percentile of the structural distance
  double area = 0;                ///< share of the leaf
  float lowest = 0, highest = 0;  ///< of the structural distance
  double pixels = 0;              ///< area in working pixels
};

/// Entry i belongs to region i + 1.
std::vector<RegionShape> describeRegions(const LeafStructure& structure);

/// 1 for equal regions: overlap of the distance ranges times exp(-ln^2(area ratio) / (2 0.6^2)) (leaf_textures.md, 5).
double similarity(const RegionShape& a, const RegionShape& b);

/// The thesis's own: overlap of the whole distance ranges over 1 + the square of the difference of the areas in pixels.
/// It changes with the resolution, and sorts by area alone.
double thesisSimilarity(const RegionShape& a, const RegionShape& b);

/// For each region of the target one of the best fifth (at least three) of the example's, drawn by `random`; 1.. .
std::vector<int> matchRegions(const LeafStructure& target, const LeafStructure& example, RandomSequence& random,
                              const RegionParameters& parameters = {});

/// The thesis's own match: of the best share of the example's regions by thesisSimilarity one by chance, however often
/// it is used and whether blade or petiole.
std::vector<int> matchRegionsAsThesis(const LeafStructure& target, const LeafStructure& example, RandomSequence& random,
                                      double best = 0.2);

/// The match by which `target` takes colours of `example`: by the target's region parameters (held: by their own seed,
/// and `random` moves on all the same), and by hand where it has pairs for this example. 1.. .
std::vector<int> chooseRegions(const LeafStages& target, const LeafStages& example, RandomSequence& random,
                               bool asThesis = false);

/// The region at a place of the photo, 0: none.
int regionAt(const LeafStages& stages, const LabelField& regions, QPointF photo);

}  // namespace windfall::model
