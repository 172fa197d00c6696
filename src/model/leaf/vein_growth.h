// Main and lateral veins, grown by seed inside the leaf.
#pragma once

#include <QImage>

#include "kernels/random.h"
#include "model/leaf/axis.h"
#include "model/leaf/leaf.h"
#include "model/leaf/vein.h"

namespace windfall::model {

/// A walk from `from` to `to` in steps of 0.6 to 1 `step`, each turned by at most `turn` degrees, calmer near the end;
/// it ends exactly at `to`. About 1.31 |to - from| / step steps (leaf_textures.md, 3).
Polygon growWalk(QPointF from, QPointF to, double step, double turn, RandomSequence& random);

/// Veins of the leaf: a main vein from the petiole through the root to every main tip (several for palmate leaves),
/// laterals by the angles of `parameters`, and finer veins between them if they are wanted. `tips` are the main tips
/// given by hand; empty: found by the outline. All points lie on the mask, laterals do not cross. Photo pixels.
Veins growVeins(const QImage& mask, const Polygon& border, const LeafAxis& axis, const Polygon& tips,
                const VeinParameters& parameters);

/// Draws veins up to `highestOrder` as white lines on black, antialiased, with their widths. The picture's corner is at
/// `origin` of the photo, `scale` picture pixels are a photo pixel.
QImage drawVeins(const Veins& veins, QSize size, QPointF origin, double scale, int highestOrder = 100);

}  // namespace windfall::model
