// An artist's edits on rigid bodies that exist already: nothing is read or built anew.
#pragma once

#include <memory>

#include "model/plant/bodies.h"

namespace windfall::model {

/// Sets the attributes of all links from `edits` by bone name, defaults where there are none. A pinned link stands
/// still: its joint and those of all that carries it are locked, and the wind does not press on it.
void applyEdits(sim::Tree& tree, const PlantGeometry& geometry, const std::vector<int>& boneOfLink,
                const std::map<QString, LinkAttributes>& edits);

/// A copy of `tree` (made of `geometry` and `bodies`, perhaps scaled) with the attributes of `edits`. Geometry, leaves
/// and their sites stay.
std::shared_ptr<const sim::Tree> withEdits(const sim::Tree& tree, const PlantGeometry& geometry,
                                           const PlantBodies& bodies, const std::map<QString, LinkAttributes>& edits);

}  // namespace windfall::model
