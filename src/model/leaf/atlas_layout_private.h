// Where textures lie in an atlas; private to model.
#pragma once

#include <QPoint>
#include <QSize>
#include <optional>
#include <vector>

#include "model/leaf/atlas_settings.h"

namespace windfall::model {

struct AtlasLayout {
  QSize size;  ///< px
  double scale = 1;
  std::vector<QRect> places;
  std::vector<bool> turned;
};

/// The largest common scale at which all textures fit with gaps, at most 1 or what `leafPixels` asks for; with rotation
/// the best of lying as they are, all upright, all on their side, and as the largest does. Of an automatic size the
/// smallest one from 64 to 8192 px, or half as high or wide, in which they need not be smaller than wanted, else the
/// largest.
std::optional<AtlasLayout> layOut(const std::vector<QSize>& sizes, const AtlasSettings& settings);

}  // namespace windfall::model
