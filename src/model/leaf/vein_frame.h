// The frame in which a leaf's texture lies: along the nearest vein, on one side of the main vein.
#pragma once

#include <QPointF>
#include <vector>

#include "model/leaf/stages.h"

namespace windfall::model {

/// A row-major field a quantity, of the structure's size. Only pixels on the leaf have a meaning.
struct VeinFrame {
  std::vector<float> angle;       ///< direction of the veins near by from root to tip, radians from +x, y down
  std::vector<signed char> side;  ///< +1 or -1: which side of the line from root to tip
  std::vector<float> reach;       ///< distance to the middle of the nearest vein, px; a little below 0 at most
  std::vector<float> margin;      ///< distance to the margin over half its largest, 0..1
  std::vector<float> standing;    ///< of the nearest vein, 0..1: root of the share of the leaf that it serves here
  int longSide = 512;             ///< px, of one leaf's picture: what lengths are measured by
};

/// `root` and `tip` in working pixels. The veins of a structure are where its vein distance is 0.
VeinFrame findVeinFrame(const LeafStructure& structure, QPointF root, QPointF tip);

}  // namespace windfall::model
