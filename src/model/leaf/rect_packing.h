// Rectangles packed into a square.
#pragma once

#include <QPoint>
#include <QSize>
#include <optional>
#include <vector>

namespace windfall::model {

/// Top left corners in the order of `sizes`, or nothing when they do not fit into side × side (skyline, stb_rect_pack).
std::optional<std::vector<QPoint>> packRectangles(const std::vector<QSize>& sizes, int side);

}  // namespace windfall::model
