#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/leaf/guided_private.h"

namespace windfall::model {

namespace {

/// A place of the example costs so much more, in squared guides, for each time that it is used above the share that is
/// free; uses are counted over a window around it.
constexpr float kUseCost = 0.02f, kFreeUse = 2, kMostUse = 20;
constexpr int kUseReach = 3;  // px

}  // namespace

PatchTurns::PatchTurns(int stride) {
  for (int mirrored = 0; mirrored < 2; ++mirrored) {
    for (int angle = 0; angle < kTurns; ++angle) {
      const double turn = 2 * std::numbers::pi * angle / kTurns, c = std::cos(turn), s = std::sin(turn);
      for (int k = 0; k < kPatchPixels; ++k) {
        const int column = k % kPatchSide - kPatchRadius, row = k / kPatchSide - kPatchRadius;
        const double dx = column, dy = mirrored ? -row : row;
        const int x = static_cast<int>(std::lround(c * dx - s * dy)),
                  y = static_cast<int>(std::lround(s * dx + c * dy));
        step_[static_cast<size_t>(mirrored * kTurns + angle)][static_cast<size_t>(k)] = y * stride + x;
      }
      cos_[static_cast<size_t>(angle)] = static_cast<float>(c);
      sin_[static_cast<size_t>(angle)] = static_cast<float>(s);
    }
  }
}

PatchField::PatchField(PatchImage& targetImage, PatchImage& exampleImage)
    : target(targetImage), example(exampleImage), turns(exampleImage.stride), matches(targetImage.leaf.size()) {
  for (int y = 0; y < target.height; ++y) {
    for (int x = 0; x < target.width; ++x) {
      if (target.leaf[target.at(x, y)]) places.push_back({x, y});
    }
  }
}

PatchMatch PatchField::placed(int x, int y, int ex, int ey) const {
  const size_t t = target.at(x, y), e = example.at(ex, ey);
  return {static_cast<float>(ex), static_cast<float>(ey), kNoMatch,
          PatchTurns::between(target.side[t] != example.side[e], target.angle[t], example.angle[e])};
}

void chargeUse(PatchField& field) {
  PatchImage& example = field.example;
  const int width = example.width, height = example.height;
  // Sums over all that lies above and left.
  std::vector<int> sums(static_cast<size_t>(width + 1) * static_cast<size_t>(height + 1), 0);
  const auto at = [&](int x, int y) -> int& {
    return sums[static_cast<size_t>(y) * static_cast<size_t>(width + 1) + static_cast<size_t>(x)];
  };
  for (const auto& [x, y] : field.places) {
    const PatchMatch& match = field.matches[field.target.at(x, y)];
    if (match.exists()) ++at(match.column() + 1, match.row() + 1);
  }
  for (int y = 1; y <= height; ++y) {
    for (int x = 1; x <= width; ++x) at(x, y) += at(x - 1, y) + at(x, y - 1) - at(x - 1, y - 1);
  }
  const auto leaf =
      static_cast<double>(std::count_if(example.leaf.begin(), example.leaf.end(), [](auto on) { return on != 0; }));
  const auto expected =
      std::max(0.05f, static_cast<float>(static_cast<double>(field.places.size()) / std::max(1.0, leaf)));
  for (int y = 0; y < height; ++y) {
    const int top = std::max(0, y - kUseReach), bottom = std::min(height, y + kUseReach + 1);
    for (int x = 0; x < width; ++x) {
      const int left = std::max(0, x - kUseReach), right = std::min(width, x + kUseReach + 1);
      const int used = at(right, bottom) - at(left, bottom) - at(right, top) + at(left, top);
      const float share = static_cast<float>(used) / static_cast<float>((right - left) * (bottom - top)) / expected;
      example.guides[example.at(x, y)].use = std::sqrt(kUseCost * std::clamp(share - kFreeUse, 0.f, kMostUse));
    }
  }
}

}  // namespace windfall::model
