// Finishing touches of space colonization: weeping shoots, broken wood (growers.md, 1.5 and 4).
#pragma once

#include "model/plant/grow/grown.h"
#include "model/plant/grow/settings.h"

namespace windfall::model::growth {

/// Hangs shoots from the tips and from a share of the thin inner nodes; `size` scales their length. Radii must be set.
void hangShoots(Grown& grown, const ColonizationSettings& settings, double size, quint64 seed);

/// Breaks twigs off; what stays keeps its radius. `breakage` is the chance of a thin link to go with all it carries.
void breakTwigs(Grown& grown, double breakage, quint64 seed);

}  // namespace windfall::model::growth
