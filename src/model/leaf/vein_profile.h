// What veins do to the colours beside them, measured on one leaf and given to another.
#pragma once

#include <vector>

#include "model/leaf/stages.h"
#include "model/leaf/vein_frame.h"

namespace windfall::model {

/// A leaf's colours and where its veins lie.
struct VeinedLeaf {
  const LeafStructure& structure;
  const VeinFrame& frame;
  const std::vector<float>& lab;  ///< CIE L*a*b*, three floats a pixel of the structure's size
};

/// The made leaf's colours, with what its veins lack of the example's added: colours without their low-pass, as medians
/// over like distances from a vein's middle and like standing, are those of the example afterwards. So faint veins do
/// not get lost where patches meet, and veins look as strong as they do in the photo. Petioles keep their colours.
std::vector<float> restoreVeins(const VeinedLeaf& made, const VeinedLeaf& example);

}  // namespace windfall::model
