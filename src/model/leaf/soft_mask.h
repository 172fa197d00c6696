// The margin of a leaf between the pixels of its mask.
#pragma once

#include <QImage>

namespace windfall::model {

/// A mask (Grayscale8) in another size, Grayscale8, with a margin of about two pixels. Where it is enlarged, steps of
/// its pixels are not: how much of a pixel at the margin is leaf is told by its colour between those of leaf and ground
/// near by, a guided filter of the mask (He and others 2010, leaf_textures.md, 10). `photo`: what was masked, RGBA8888
/// of the mask's size, or null.
QImage softMask(const QImage& mask, const QImage& photo, QSize size);

}  // namespace windfall::model
