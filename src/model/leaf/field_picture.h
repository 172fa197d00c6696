// Fields of a leaf as colours, with the numbers for a legend; and regions in the colours of their match.
#pragma once

#include <QImage>
#include <utility>
#include <vector>

#include "model/leaf/stages.h"

namespace windfall::model {

enum class LeafField { Structural, VeinDistance, Direction, Side, Margin };

/// How a field is read: colours from low to high, and what they mean.
struct FieldScale {
  std::vector<QRgb> ramp;    ///< evenly from `low` to `high`; two of them apart: two kinds, no scale
  double low = 0, high = 1;  ///< costs, pixels of the texture, degrees, or -1 and +1
  bool twoKinds = false;
};

/// A field over the photo, of the photo's size, transparent off the leaf; `scale` becomes its legend's. Direction, side
/// and margin need Stage::Regions, the others Stage::Distance.
QImage fieldPicture(const LeafStages& stages, LeafField field, FieldScale& scale);

/// The colour of a region by its number; neighbours in number are far apart in hue.
QRgb regionColour(int region);

/// Regions of a leaf over its photo, region i + 1 in the colour of `colourOf[i]`, borders dark. Negative: the colour of
/// the number without its sign, much paler.
QImage regionPicture(const LeafStages& stages, const LabelField& regions, const std::vector<int>& colourOf);

}  // namespace windfall::model
