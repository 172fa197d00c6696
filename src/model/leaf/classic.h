// The classic synthesis: a pyramid of superpixels, smoothed, with a layer of detail.
#pragma once

#include <vector>

#include "model/leaf/stages.h"
#include "model/leaf/superpixels.h"

namespace windfall::model {

/// Colours of the target, three floats a pixel, Lab. `colours`: the example's (workingColours). `match`: the example's
/// region for each of the target's, 1.. . Empty when cancelled or without superpixels (leaf_textures.md, 6 to 9a).
std::vector<float> synthesizeClassic(const LeafStages& target, const LeafStages& example,
                                     const std::vector<float>& colours, const std::vector<int>& match,
                                     const SynthesisParameters& parameters, quint64 seed, Progress& progress);

/// For each superpixel of the target's finest level the Lab of one of the example's. Level by level: of the
/// `candidates` nearest in structural and vein distance, both as shares of their region's, within the matched region
/// `choices` are drawn, and the one is taken whose colour is nearest to that of the level before at this place
/// (leaf_textures.md, 7).
std::vector<SuperpixelMean> chooseSuperpixels(const LeafStages& target, const LeafStages& example,
                                              const std::vector<float>& colours, const std::vector<int>& match,
                                              const SynthesisParameters& parameters, quint64 seed);

}  // namespace windfall::model
