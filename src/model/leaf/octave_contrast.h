// Contrast that averaging has taken away, octave by octave.
#pragma once

#include <vector>

#include "model/leaf/stages.h"

namespace windfall::model {

/// A leaf's structure and its colours, three floats a pixel, Lab.
struct ColouredLeaf {
  const LeafStructure& structure;
  const std::vector<float>& lab;
};

/// The made leaf's colours with octaves that are about as strong in lightness as the example's: where patches overlap
/// they are means, and calm ones fit everywhere, so that each octave has lost up to a third. What is strong already
/// (spots, veins) is left as it is. Only the blades count. The same bits for any number of threads.
std::vector<float> restoreContrast(const ColouredLeaf& made, const ColouredLeaf& example);

}  // namespace windfall::model
