// Short shoots: the thin axes that clusters of leaves stand on. They are no part of the skeleton.
#pragma once

#include <vector>

#include "model/plant/geometry.h"

namespace windfall::model {

struct ShortShoot {
  vec3 base{0}, direction{0};  ///< m, plant space; a unit vector
  float length = 0, radius = 0;
  std::uint32_t bone = 0;
};

/// Adds a thin three-sided cone for each, moved by its bone alone, and the part that they make together, one piece a
/// shoot; none: no part.
void addShortShoots(const std::vector<ShortShoot>& shoots, int material, PlantGeometry& geometry);

}  // namespace windfall::model
