// Polygons round a leaf; private to model.
#pragma once

#include "model/leaf/contour.h"

namespace windfall::model {

/// A closed polygon with every edge moved outwards by `distance`, corners where the moved edges meet (at most three
/// times as far). Any orientation.
Polygon outwards(const Polygon& closed, double distance);

/// A convex polygon of at most `corners` corners that holds all points, `distance` further out: edges of the convex
/// hull are left out one by one, each time the one that adds the least area.
Polygon enclosingPolygon(const Polygon& points, size_t corners, double distance);

}  // namespace windfall::model
