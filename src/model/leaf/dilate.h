// Colours spread outwards, so that filtering and mip levels find no foreign colour at a leaf's edge.
#pragma once

#include <QImage>

namespace windfall::model {

/// Gives every pixel with alpha below `solid` the colour of the nearest pixel with at least that; alpha is kept.
/// RGBA8888 in and out.
QImage spreadColours(const QImage& image, int solid = 250);

}  // namespace windfall::model
