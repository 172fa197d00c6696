// Leaves painted from code as if photographed on paper: for the sample project and for tests.
#pragma once

#include <QImage>
#include <QPointF>

#include "model/sample/leaf_outline.h"

namespace windfall::model {

struct PaintedLeaf {
  LeafShape shape = LeafShape::Ovate;
  /// 0 summer green, 0.5 yellow with green along the veins, 1 red and brown.
  double autumn = 0;
  /// Share of anthocyanin in autumn: 0 turns yellow (birch), 1 turns red (maple).
  double redness = 0;
};

/// The photo, its exact mask (white leaf), and where the petiole meets the blade.
struct PaintedPhoto {
  QImage photo;  ///< RGB32
  QImage mask;   ///< Grayscale8
  QPointF root;  ///< px
  QPointF tip;   ///< px
};

/// Paints one leaf, upright with a small turn, on pale paper with a soft shadow. `size`: long side in px, 64 at least.
/// The same arguments give the same bits.
PaintedPhoto paintLeafPhoto(const PaintedLeaf& leaf, quint64 seed, int size);

}  // namespace windfall::model
