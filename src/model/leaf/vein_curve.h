// Curves of veins from the points that were stepped, clicked or dragged.
#pragma once

#include "model/leaf/contour.h"

namespace windfall::model {

/// The point at `t` (0..1) of the Bezier curve with these control points, by repeated interpolation (de Casteljau).
QPointF deCasteljau(Polygon control, double t);

/// One Bezier curve of all points, sampled about every two pixels; it begins and ends at theirs (the thesis's veins).
Polygon bezierCurve(const Polygon& control);

/// Uniform cubic B-spline that begins and ends at the points' ends, sampled about every two pixels: wiggles stay,
/// corners go.
Polygon smoothCurve(const Polygon& points);

/// A curve through all points (centripetal Catmull-Rom), sampled about every two pixels; a polyline as dense as that is
/// given back as it is.
Polygon throughPoints(const Polygon& points);

/// Sum of the lengths of a polyline's pieces.
double lengthOf(const Polygon& line);

}  // namespace windfall::model
