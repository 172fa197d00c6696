// The veins that a photo shows.
#pragma once

#include <QImage>
#include <QPoint>
#include <QSize>
#include <vector>

#include "model/leaf/distance.h"

namespace windfall::model {

/// Geodesic voting (leaf_textures.md, 3): ridges of lightness make cheap ways; every pixel walks to the root; a pixel
/// that more than `detail` of the leaf's pixels pass is a vein. `photo` (RGBA8888) and `types` (Outside or not) are of
/// working size; the result has the veins marked.
std::vector<Tissue> extractVeins(const QImage& photo, std::vector<Tissue> types, QPoint root, double detail = 0.004);

}  // namespace windfall::model
