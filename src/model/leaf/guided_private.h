// What the parts of the guided synthesis share: matches, turned patches, fields of them; private to it.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <vector>

#include "model/leaf/patch_image.h"

namespace windfall::model {

inline constexpr int kPatchRadius = 2, kPatchSide = 5, kPatchPixels = 25, kTurns = 64;
inline constexpr float kNoMatch = 1e30f;

/// Four floats that one instruction adds or multiplies.
using Lanes = float __attribute__((vector_size(16)));
static_assert(sizeof(PatchPixel) == sizeof(Lanes));

inline Lanes lanesOf(const PatchPixel& pixel) {
  Lanes lanes;
  std::memcpy(&lanes, &pixel, sizeof lanes);
  return lanes;
}

/// Where a patch of the target takes its colours from. Places lie between pixels, so that a piece which is handed on
/// from neighbour to neighbour stays in shape however it is turned.
struct PatchMatch {
  float x = -1, y = -1;  ///< px of the example; negative: none
  float cost = kNoMatch;
  std::uint32_t turn = 0;  ///< PatchTurns

  bool exists() const { return x >= 0; }
  // A library's lround is slower than a whole match; a place that exists is never negative.
  // NOLINTBEGIN(bugprone-incorrect-roundings)
  int column() const { return static_cast<int>(x + 0.5f); }
  int row() const { return static_cast<int>(y + 0.5f); }
  // NOLINTEND(bugprone-incorrect-roundings)
};

/// Turns of 1/64 of the circle, then the same ones mirrored: steps in a padded picture of the pixels of a patch.
class PatchTurns {
 public:
  explicit PatchTurns(int stride);

  /// Which turn takes a direction of the target to one of the example, both in steps of 1/64.
  static std::uint32_t between(bool mirrored, int target, int example) {
    const int angle = mirrored ? example + target : example - target;
    return static_cast<std::uint32_t>((mirrored ? kTurns : 0) + (angle & (kTurns - 1)));
  }
  static bool isMirrored(std::uint32_t turn) { return turn >= kTurns; }

  const std::array<int, kPatchPixels>& steps(std::uint32_t turn) const { return step_[turn]; }
  /// Any step, turned.
  std::array<float, 2> turned(std::uint32_t turn, float dx, float dy) const {
    const float c = cos_[turn % kTurns], s = sin_[turn % kTurns], across = isMirrored(turn) ? -dy : dy;
    return {c * dx - s * across, s * dx + c * across};
  }
  float cosine(int angle) const { return cos_[static_cast<size_t>(angle & (kTurns - 1))]; }

 private:
  std::array<std::array<int, kPatchPixels>, 2 * kTurns> step_{};
  std::array<float, kTurns> cos_{}, sin_{};
};

/// The matches of a level's pixels; those off the leaf have none.
struct PatchField {
  PatchField(PatchImage& target, PatchImage& example);

  /// A place of the example, turned as its frame is against the target's.
  PatchMatch placed(int x, int y, int ex, int ey) const;
  bool inside(const PatchMatch& match) const {
    return match.x >= 0 && match.y >= 0 && match.column() < example.width && match.row() < example.height;
  }

  struct Place {
    int x, y;
  };
  PatchImage& target;
  PatchImage& example;
  PatchTurns turns;
  std::vector<PatchMatch> matches;  ///< of each pixel of the target
  std::vector<Place> places;        ///< of the leaf's pixels
};

/// `match`: the example's region for each of the target's, 1.. . Distances of the target become those that the matched
/// regions reach over, in part: what was chosen for a region is not undone by the search.
void followRegions(PatchField& field, const std::vector<int>& match);

/// Nearest neighbours in guides that are normalised within the matched regions, in pieces that stay whole.
void startFromRegions(PatchField& field, const std::vector<int>& match);

/// Twice as fine a field; pieces stay in shape.
void startFromCoarser(PatchField& field, const PatchField& coarser);

/// Makes places of the example dearer that many of the target's take over: nothing repeats, and calm places, which fit
/// everywhere, do not fill the leaf (Kaspar et al. 2015, self tuning texture optimization).
void chargeUse(PatchField& field);

/// Colours whose steps from pixel to pixel are those of the example, at small cost in the colours themselves: where two
/// patches of different brightness meet, the step between them is spread out instead of seen as an edge.
void levelSeams(PatchField& field);

}  // namespace windfall::model
