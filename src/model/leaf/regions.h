// Regions of a leaf: what lies between the veins.
#pragma once

#include <QPointF>
#include <vector>

#include "model/leaf/distance.h"
#include "model/leaf/stages.h"

namespace windfall::model {

/// Local maxima of the distance to the veins; working pixels (leaf_textures.md, 5).
std::vector<QPointF> automaticMarkers(const std::vector<Tissue>& types, QSize size);

/// Watershed by flooding from the markers with the veins as ridges; every pixel of the leaf gets a region 1.. .
LabelField growRegions(const std::vector<Tissue>& types, QSize size, const std::vector<QPointF>& markers);

}  // namespace windfall::model
