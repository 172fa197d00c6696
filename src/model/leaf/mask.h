// Which pixels are leaf.
#pragma once

#include <QImage>

#include "model/leaf/leaf.h"
#include "model/progress.h"
#include "sim/result.h"

namespace windfall::model {

/// Finds the leaf in a photo: Grayscale8 of the photo's size, 255 blade and petiole, 0 ground and holes.
/// The ground's colour is followed over the picture, so that uneven light does not matter; of lightness and colour the
/// one that separates best decides; then the margin is set half-way between leaf and ground where it lies
/// (leaf_textures.md, 2). A picture with transparency brings its mask, and a bare mask is its own (bareMask). Error: no
/// leaf.
Result<QImage> automaticMask(const QImage& photo, const MaskParameters& parameters, Progress& progress);

/// Whether a picture is a mask and no photo: black and white alone but for a thin margin. Returns it with the leaf
/// white, whichever way it was; null: it is a photo.
QImage bareMask(const QImage& photo);

}  // namespace windfall::model
