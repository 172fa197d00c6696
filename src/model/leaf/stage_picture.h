// Pictures of stages finer than the photo.
#pragma once

#include "model/leaf/stages.h"

namespace windfall::model {

/// As stagePicture, but contour, veins and regions with `fine` pixels a pixel of the photo: lines over a small photo
/// stay lines when it is looked at closely.
QImage fineStagePicture(const LeafStages& stages, Stage stage, int fine);

}  // namespace windfall::model
