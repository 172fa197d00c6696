// Colours spread outwards, so that filtering and mip levels find no foreign colour at a leaf's edge.
#pragma once

#include <QImage>
#include <cstdint>
#include <vector>

namespace windfall::model {

/// For every pixel, row by row, the index of the nearest one whose alpha is at least `solid`; its own where it is such
/// a one itself. Empty where there is none.
std::vector<std::int32_t> nearestSolid(const QImage& image, int solid = 250);

/// Gives every pixel the colour of the one that `nearest` names; alpha is kept. RGBA8888, Grayscale8 or Grayscale16.
void spreadFrom(const std::vector<std::int32_t>& nearest, QImage& image);

/// Both at once. RGBA8888 in and out.
QImage spreadColours(const QImage& image, int solid = 250);

}  // namespace windfall::model
