// The veins of a leaf as curves.
#pragma once

#include <QPointF>
#include <vector>

namespace windfall::model {

/// One vein, from where it leaves its parent towards its tip; photo pixels.
struct Vein {
  int order = 1;                ///< 1 main, 2 lateral, 3 tertiary
  int parent = -1;              ///< index of the vein it leaves; -1: starts at the root
  std::vector<QPointF> points;  ///< polyline, about 2 px apart
  double startWidth = 3;        ///< px
  double endWidth = 1.5;        ///< px
  bool operator==(const Vein&) const = default;
};

using Veins = std::vector<Vein>;

}  // namespace windfall::model
