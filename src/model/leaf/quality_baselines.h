// Simple ways to colour a leaf that a score must tell from good ones.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "model/leaf/quality.h"

namespace windfall::model {

/// What a baseline works on; both leaves have reached Stage::Superpixels.
struct BaselineInput {
  const LeafStages& target;
  const LeafStages& example;
  const std::vector<float>& colours;  ///< of the example (workingColours)
  const std::vector<int>& match;      ///< the example's region for each of the target's, 1..
  quint64 seed = 1;
};

struct Baseline {
  std::string name;
  std::vector<float> (*colour)(const BaselineInput& input);  ///< Lab, three floats a pixel of the target
};

/// One mean colour, a mean colour a region, 64 superpixels, random pixels, random patches of 32 px, the photo stretched
/// row by row (leaf_textures.md, 11).
std::vector<Baseline> naiveBaselines();

/// Root and tip in working pixels.
std::array<QPointF, 2> workingAxis(const LeafStages& stages);

}  // namespace windfall::model
