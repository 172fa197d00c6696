// Region markers from a picture, and whether markers by hand can serve.
#pragma once

#include <QImage>
#include <vector>

#include "model/leaf/stages.h"

namespace windfall::model {

/// The centres of the white spots, px.
std::vector<QPointF> markersOf(const QImage& spots);

/// An error where the leaf has markers of its own but none lies on it, or all lie in one place: regions cannot be
/// matched then. `stages` have reached Stage::Regions.
Status checkMarkers(const LeafStages& stages);

}  // namespace windfall::model
