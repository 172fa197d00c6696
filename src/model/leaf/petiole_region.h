// The petiole as a region of its own: it lends its colours to no blade, and takes none from one.
#pragma once

#include <QPointF>
#include <vector>

#include "model/leaf/stages.h"

namespace windfall::model {

/// Gives the pixels of `regions` that lie along `petiole` (working pixels, free end to root) a label of their own after
/// the others. Nothing changes where there is no petiole or where its pixels would be most of the leaf.
void setPetioleApart(LabelField& regions, const std::vector<QPointF>& petiole);

}  // namespace windfall::model
