// Several leaves side by side as one example, so that one texture can take its colours from all of them.
#pragma once

#include <vector>

#include "model/leaf/stages.h"
#include "model/leaf/vein_frame.h"

namespace windfall::model {

/// One example whose regions are those of all: their working images stand in a grid, each region keeps its number among
/// its leaf's (JoinedLeaf::before), petioles become one region. All have reached Stage::Superpixels; of the result only
/// what an example needs is filled in: photo, mask, alpha, frame, scale, `seen`, joined. `evenTones`: how far the mean
/// colours of their blades are moved to the first one's, 0..1, as if all were taken in one light; leaves of quite other
/// colours stay as they are.
LeafStages joinExamples(const std::vector<LeafStages>& examples, double evenTones = 0);

/// What lends its colours to textures of `of`: the examples joined, where there are several and its parameters mix
/// them; else they as they are.
std::vector<LeafStages> lendersOf(const LeafStages& of, std::vector<LeafStages> examples);

/// The vein frame of an example's seen structure, each joined leaf's by itself.
VeinFrame exampleFrame(const LeafStages& example);

/// The region of an example (joined or not) at a place of the photo of one of its leaves; 0: none, or no such leaf.
/// `target`: the leaf that an id of 0 stands for.
int exampleRegionAt(const LeafStages& example, AssetId leaf, AssetId target, QPointF photo);

}  // namespace windfall::model
