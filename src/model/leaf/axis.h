// Where a leaf begins and ends.
#pragma once

#include <QImage>
#include <QPointF>
#include <optional>

#include "model/leaf/contour.h"

namespace windfall::model {

struct LeafAxis {
  QPointF root;     ///< where the petiole meets the blade, px
  QPointF tip;      ///< farthest point of the blade's border from the root
  Polygon petiole;  ///< from its free end to the root; empty where there is none
};

/// The petiole is what an opening takes away and what keeps its width, is thin and joins the blade abruptly; without
/// one the root is the blunter end of a long blade, or the low border point near the middle of a round one. A given
/// root wins (leaf_textures.md, 2).
LeafAxis findAxis(const QImage& mask, const Polygon& border, std::optional<QPointF> givenRoot);

}  // namespace windfall::model
