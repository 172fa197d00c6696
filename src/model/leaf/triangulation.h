// Triangles over a polygon with points and lines inside it.
#pragma once

#include <QPointF>
#include <cstdint>
#include <utility>
#include <vector>

#include "model/leaf/contour.h"

namespace windfall::model {

struct Triangulation {
  std::vector<QPointF> points;         ///< the given ones in order, then those that crossing lines made
  std::vector<std::uint32_t> corners;  ///< three a triangle, one way round for all
};

/// Constrained Delaunay triangulation (CGAL) of a closed polygon, further points, and lines between points by index
/// (polygon first, then `inside`). Triangles whose centroid is outside the polygon are left out. Equal points are one.
Triangulation triangulate(const Polygon& polygon, const std::vector<QPointF>& inside,
                          const std::vector<std::pair<std::uint32_t, std::uint32_t>>& lines);

/// Whether a place is inside a closed polygon (even-odd).
bool contains(const Polygon& polygon, QPointF place);

}  // namespace windfall::model
