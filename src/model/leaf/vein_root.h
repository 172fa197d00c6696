// Where a leaf without a visible petiole begins, by the veins that its photo shows.
#pragma once

#include <QImage>

#include "model/leaf/axis.h"

namespace windfall::model {

/// The root of a leaf whose outline has no petiole: the place inside where strong veins meet from many sides (palmate
/// and peltate leaves), or else the place of the border near the guess where the midrib ends. `axis` is what the
/// outline alone says; it is given back where the photo shows no veins. Photo pixels.
LeafAxis rootByVeins(const QImage& photo, const QImage& mask, const Polygon& border, const LeafAxis& axis);

}  // namespace windfall::model
