// The fine detail of an example, laid over a smooth layer: global variation and local detail apart.
#pragma once

#include <vector>

#include "kernels/random.h"
#include "model/leaf/stages.h"

namespace windfall::model {

/// What the detail layer is made of: three floats a pixel (Lab minus the smooth layer), and where a pixel lies.
struct DetailSource {
  const LeafStructure* structure = nullptr;
  const std::vector<float>* layer = nullptr;
};

/// A zero-mean detail layer for the target from overlapping windows of the example that lie at like distances from root
/// and veins; of some the one that fits best to its neighbours and has its veins where the target's are
/// (leaf_textures.md, 9a). Three floats a pixel.
std::vector<float> layDetail(const LeafStructure& target, const DetailSource& example, RandomSequence& random,
                             Progress& progress);

}  // namespace windfall::model
