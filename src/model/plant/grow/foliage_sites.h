// Leaves on a grown skeleton (growers.md, 5.2, 5.3).
#pragma once

#include "model/plant/geometry.h"
#include "model/plant/grow/axes.h"
#include "model/plant/grow/settings.h"

namespace windfall::model::growth {

/// Short shoots and the leaves on them; `geometry` has the bones already. Short shoots are added to its mesh as a
/// part of this material, even where the plant is bare.
void placeFoliage(const Grown& grown, const AxisTree& tree, const FoliageSettings& foliage, quint64 seed, int material,
                  PlantGeometry& geometry);

/// One-sided leaf area that a plant of this trunk and crown bears, m2.
double leafAreaOf(const Grown& grown, const FoliageSettings& foliage);

}  // namespace windfall::model::growth
