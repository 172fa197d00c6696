// Veins as curves from a picture of them.
#pragma once

#include <QImage>

#include "model/leaf/axis.h"
#include "model/leaf/vein.h"

namespace windfall::model {

/// Follows white lines on black, thinned to their middles, from the root outwards: a tree whose longest way is the main
/// vein, what leaves it a lateral, and so on; widths as drawn. Gaps of a few pixels are bridged, spurs shorter than the
/// lines are wide left out. The picture's corner is at `origin` of the photo, `scale` picture pixels are a photo pixel;
/// the result, in photo pixels, begins at `root`. Empty: no line in it.
Veins traceVeins(const QImage& lines, QPointF root, QPointF origin, double scale);

/// A picture of veins drawn elsewhere, Grayscale8 of the photo's size: white lines, or dark ones on a light ground.
Veins readVeinPicture(const QImage& picture, const LeafAxis& axis);

/// The veins that a photo shows (extractVeins), as curves with the petiole before the main vein. `detail`: share of the
/// blade that a vein must serve; photo pixels.
Veins photoVeins(const QImage& photo, const QImage& mask, QRect frame, const LeafAxis& axis, double detail);

}  // namespace windfall::model
