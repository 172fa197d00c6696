// Where textures lie in an atlas; private to model.
#pragma once

#include <QPoint>
#include <QSize>
#include <optional>
#include <vector>

#include "model/leaf/atlas_settings.h"

namespace windfall::model {

struct AtlasLayout {
  double scale = 1;
  std::vector<QRect> places;
  std::vector<bool> turned;
};

/// The largest common scale, 1 at most, at which all textures fit with gaps; with rotation the best of lying as they
/// are, all upright, all on their side, and as the largest does.
std::optional<AtlasLayout> layOut(const std::vector<QSize>& sizes, const AtlasSettings& settings);

}  // namespace windfall::model
