// The colours that an example lends.
#pragma once

#include <vector>

#include "model/leaf/stages.h"

namespace windfall::model {

/// The photo in working size as Lab, three floats a pixel. Colours at the margin come from a little inside the leaf, so
/// that nothing of the ground shines through.
std::vector<float> workingColours(const LeafStages& stages);

}  // namespace windfall::model
