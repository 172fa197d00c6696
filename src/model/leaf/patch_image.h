// One level of a leaf for patch matching: colours, guides and vein frame, padded so that no patch needs a bound check.
#pragma once

#include <cstdint>
#include <vector>

#include "model/leaf/stages.h"
#include "model/leaf/vein_frame.h"

namespace windfall::model {

/// Pixels around a picture that any turned patch of 5 x 5 can reach.
inline constexpr int kPatchPadding = 4;

struct PatchPixel {
  float l = 0, a = 0, b = 0;
  float penalty = 0;  ///< off the leaf: its square is added to a patch that reaches there
};

/// Where a pixel lies in its leaf: what equal places of two leaves have in common.
struct PatchGuide {
  float distance = 0, vein = 0, margin = 0, line = 0;
  float standing = 0;  ///< of the vein on or beside which it lies, fading with the distance from it
  float petiole = 0;   ///< so large that nothing is exchanged between petiole and blade
  float use = 0;       ///< of the example: dearer the more it is used (guided_private.h, chargeUse)
  float unused = 0;
};

struct PatchImage {
  int width = 0, height = 0, stride = 0;  ///< stride: padded width
  std::vector<PatchPixel> pixels;         ///< padded
  std::vector<PatchGuide> guides;         ///< not padded, as the rest
  std::vector<std::uint8_t> leaf;
  std::vector<std::uint8_t> angle;  ///< of 64 steps of the circle
  std::vector<signed char> side;
  std::vector<std::int32_t> region;

  size_t at(int x, int y) const { return static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x); }
  size_t padded(int x, int y) const {
    return static_cast<size_t>(y + kPatchPadding) * static_cast<size_t>(stride) +
           static_cast<size_t>(x + kPatchPadding);
  }
};

/// A level for each factor, that of so many pixels of the full structure a pixel. `lab`: three floats a pixel, null for
/// a target without colours.
std::vector<PatchImage> makePatchImages(const LeafStructure& structure, const VeinFrame& frame, const float* lab,
                                        const std::vector<double>& factors);

}  // namespace windfall::model
