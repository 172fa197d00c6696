// Region markers painted as spots.
#pragma once

#include <QImage>
#include <QPointF>
#include <vector>

namespace windfall::model {

/// Centres of the white spots of a black picture, row by row; px.
std::vector<QPointF> markersOf(const QImage& spots);

}  // namespace windfall::model
