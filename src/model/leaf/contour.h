// The leaf's outline as a closed polygon.
#pragma once

#include <QImage>
#include <QPointF>
#include <vector>

namespace windfall::model {

using Polygon = std::vector<QPointF>;

/// Every border pixel of the largest white component in order (Suzuki and Abe), counter-clockwise seen with y up; px.
Polygon traceBorder(const QImage& mask);

/// Leaves out points in the middle of straight runs of a closed polygon.
Polygon mergeCollinear(const Polygon& closed);

/// Ramer, Douglas and Peucker on an open line; its ends stay.
Polygon simplifyLine(const Polygon& line, double epsilon);

/// Ramer, Douglas and Peucker on a closed polygon, split at the points nearest to `first` and `second` (root and tip):
/// no left-out point is farther than `epsilon` px from the result.
Polygon simplifyClosed(const Polygon& closed, double epsilon, QPointF first, QPointF second);

}  // namespace windfall::model
