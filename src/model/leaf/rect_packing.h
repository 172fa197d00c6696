// Rectangles packed into a larger one.
#pragma once

#include <QPoint>
#include <QSize>
#include <optional>
#include <vector>

namespace windfall::model {

/// Top left corners in the order of `sizes`, or nothing when they do not fit into `whole` (skyline, stb_rect_pack).
std::optional<std::vector<QPoint>> packRectangles(const std::vector<QSize>& sizes, QSize whole);

}  // namespace windfall::model
