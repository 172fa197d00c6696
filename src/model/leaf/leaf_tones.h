// The tone of a whole leaf: how leaves of one tree differ from each other, and how photos are brought together.
#pragma once

#include <array>
#include <vector>

#include "model/leaf/stages.h"

namespace windfall::model {

/// What is light and dark about a blade, without veins and detail; petioles are left out. CIE L*a*b*.
struct LeafTones {
  std::array<float, 3> mean{};
  std::array<float, 3> direction{};  ///< in which the blade's places differ most, of length 1; lighter is positive
  float spread = 0;                  ///< standard deviation along it
  float least = 0, most = 0;         ///< from the mean, along it: all but 3 % at either end
};

/// `lab`: three floats a pixel of a small leaf (small_leaf.h); `longSide` of one leaf, px. A blade of one colour varies
/// as if it were thicker or thinner: its direction keeps the hue.
LeafTones measureTones(const LabelField& regions, const std::vector<float>& lab, double longSide);

/// Tones of an example of Stage::Superpixels with these working colours.
LeafTones measureTones(const LeafStages& example, const std::vector<float>& colours);

/// How far a place whose tone is `at` (from the mean, along the direction) moves when its leaf is set off by `by`: all
/// the way in the middle of the example's tones, less the nearer to their end, never beyond it by more than a fifth of
/// `by`. Order is kept: of two places the lighter one stays the lighter one.
float boundedShift(const LeafTones& tones, float at, float by);

/// Where a leaf stands in the round of tones: from dark by way of the middle to light and back. Halves and ends of the
/// blade are a little ahead and behind, so that no leaf is of one tone altogether.
struct TonePhase {
  QPointF root, tip;  ///< px

  /// Radians, to be added to the seed's angle; `x`, `y` in px.
  float at(double x, double y) const;
};

/// The angle of a seed, radians: seeds in a row are golden angles apart, so that any few of them are spread evenly.
float toneAngle(quint64 seed);

/// Adds a colour to all pixels, three floats each.
void shiftColours(std::vector<float>& lab, const std::array<float, 3>& by);

}  // namespace windfall::model
