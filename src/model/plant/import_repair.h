// What imported skeletons get wrong, and how it is mended; every repair is told (PlantGeometry::notes).
#pragma once

#include "model/plant/geometry.h"
#include "sim/result.h"

namespace windfall::model {

/// Looks over bones as they were read, before tails and radii are fitted: too many of them, all in one place, or those
/// of a figure (hips, spine, hands) are errors.
Status checkSkeleton(const PlantGeometry& geometry);

/// After the fit: bones without length become no link, radii that are no number or nothing take that of their parent.
/// Several roots stand side by side. All is told.
void mendBones(PlantGeometry& geometry);

}  // namespace windfall::model
