// Guided patch synthesis in the frame of the veins.
#pragma once

#include <vector>

#include "model/leaf/patch_image.h"
#include "model/progress.h"

namespace windfall::model {

/// What one level of the pyramid works on.
struct GuidedLevel {
  PatchImage target, example;
};

/// Colours of the target's finest level, three floats a pixel, Lab; pixels off the leaf are 0. Levels from coarse to
/// fine, each twice the one before. `match`: the example's region for each region of the target, 1.. . The same bits
/// for any number of threads. `guideWeight`: how much the guides count, a pixel of a patch (leaf_textures.md, 9b:
/// region-initialised PatchMatch with turned and mirrored patches).
std::vector<float> synthesizeGuided(std::vector<GuidedLevel> levels, const std::vector<int>& match, double guideWeight,
                                    quint64 seed, Progress& progress);

}  // namespace windfall::model
