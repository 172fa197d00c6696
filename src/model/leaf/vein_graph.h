// Veins as a graph that an artist edits: each edit is a function from veins to veins.
#pragma once

#include <optional>

#include "model/leaf/vein.h"

namespace windfall::model {

/// A place on a vein.
struct VeinPlace {
  int vein = -1;
  int point = -1;       ///< nearest point
  int segment = -1;     ///< the piece it lies on: between this point and the next
  double distance = 0;  ///< px from the place asked for
  QPointF at;           ///< on the vein
};

/// The nearest place of any vein up to `highestOrder`; none within `reach` px: empty.
std::optional<VeinPlace> nearestVein(const Veins& veins, QPointF to, double reach, int highestOrder = 100);

/// The same veins with as few points as keep them within `tolerance` px: points that can be moved by hand.
Veins editableVeins(const Veins& veins, double tolerance);

/// A new vein through `points`. It grows from the vein that is nearest to its first point within `reach` px, and begins
/// on it, one order below; without any it is a main vein.
Veins withVein(Veins veins, std::vector<QPointF> points, double startWidth, double endWidth, double reach);

/// A point moved; veins that leave there follow.
Veins withMovedPoint(Veins veins, int vein, int point, QPointF to);
/// A point added on a piece.
Veins withPoint(Veins veins, int vein, int segment, QPointF at);
/// A point taken away; a vein of two points goes altogether.
Veins withoutPoint(Veins veins, int vein, int point);
/// A vein taken away, and all that leaves it.
Veins withoutVein(const Veins& veins, int vein);
/// Both widths times `factor`, 0.25 px at least.
Veins withWidth(Veins veins, int vein, double factor);
/// Its order, 1 to 4; what leaves it keeps its distance in order.
Veins withOrder(Veins veins, int vein, int order);

}  // namespace windfall::model
