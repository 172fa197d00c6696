// Outlines and veins of leaves by formula, for leaves that are drawn rather than photographed.
#pragma once

#include <QPointF>
#include <QtGlobal>
#include <vector>

namespace windfall::model {

/// Margins that the formula knows.
enum class LeafShape { Ovate, Serrate, Oak, Maple };

/// A vein as drawn: a polyline from its base to its tip, with its width at the base.
struct DrawnVein {
  std::vector<QPointF> points;
  double width = 0;
};

/// Leaf space: the blade's base is (0, 0), the tip about (0, 1), x to the right; the petiole goes down to y < 0.
struct LeafOutline {
  std::vector<QPointF> blade;    ///< closed, one point after the other
  std::vector<DrawnVein> veins;  ///< main veins first, then laterals
  std::vector<QPointF> petiole;  ///< polyline from the base downwards
};

/// Shape and veins by seed; small differences between seeds as between leaves of one tree.
LeafOutline drawOutline(LeafShape shape, quint64 seed);

}  // namespace windfall::model
