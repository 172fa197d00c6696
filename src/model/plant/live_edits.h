// An artist's edits on rigid bodies that exist already: nothing is read or built anew.
#pragma once

#include <memory>

#include "model/plant/bodies.h"

namespace windfall::model {

/// A copy of `tree` (made of `geometry` and `bodies`, perhaps scaled) with the attributes of `edits` by bone name, and
/// defaults where there are none. Geometry, leaves and their sites stay.
std::shared_ptr<const sim::Tree> withEdits(const sim::Tree& tree, const PlantGeometry& geometry,
                                           const PlantBodies& bodies, const std::map<QString, LinkAttributes>& edits);

}  // namespace windfall::model
