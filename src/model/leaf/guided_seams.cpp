#include <cmath>

#include "model/leaf/guided_private.h"

namespace windfall::model {

namespace {

constexpr float kFidelity = 0.05f;  ///< of colours beside their steps: seams are spread over 1 / its root, px
constexpr int kSweeps = 30;

/// The step of the colours from a pixel to the next one, as far as one of their two patches has the like of it.
Lanes step(const PatchField& field, int x, int y, int dx, int dy) {
  const PatchImage &target = field.target, &example = field.example;
  Lanes least{kNoMatch, kNoMatch, kNoMatch, kNoMatch}, most = -least;
  const auto add = [&](int px, int py, int way) {
    const PatchMatch& match = field.matches[target.at(px, py)];
    if (!match.exists()) return;
    const auto k = static_cast<size_t>((way * dy + kPatchRadius) * kPatchSide + way * dx + kPatchRadius);
    const size_t middle = example.padded(match.column(), match.row());
    const int offset = field.turns.steps(match.turn)[k];
    const PatchPixel& beside = example.pixels[static_cast<size_t>(static_cast<int>(middle) + offset)];
    if (beside.penalty > 0) return;
    const Lanes step = static_cast<float>(way) * (lanesOf(beside) - lanesOf(example.pixels[middle]));
    least = step < least ? step : least;
    most = step > most ? step : most;
  };
  add(x, y, 1);
  add(x + dx, y + dy, -1);
  if (least[0] > most[0]) return Lanes{};
  const Lanes own = lanesOf(target.pixels[target.padded(x + dx, y + dy)]) - lanesOf(target.pixels[target.padded(x, y)]);
  const Lanes above = own < least ? least : own;
  return above > most ? most : above;
}

}  // namespace

void levelSeams(PatchField& field) {
  PatchImage& target = field.target;
  const size_t count = target.leaf.size();
  const auto width = static_cast<size_t>(target.width);
  std::vector<Lanes> right(count, Lanes{}), down(count, Lanes{}), value(count, Lanes{});
#pragma omp parallel for schedule(static)
  for (int y = 0; y < target.height; ++y) {
    for (int x = 0; x < target.width; ++x) {
      const size_t i = target.at(x, y);
      if (!target.leaf[i]) continue;
      value[i] = lanesOf(target.pixels[target.padded(x, y)]);
      if (x + 1 < target.width && target.leaf[i + 1]) right[i] = step(field, x, y, 1, 0);
      if (y + 1 < target.height && target.leaf[i + width]) down[i] = step(field, x, y, 0, 1);
    }
  }
  const std::vector<Lanes> wanted = value;
  // Successive over-relaxation, red and black pixels in turn: the same bits for any number of threads.
  const float relaxation = 2 / (1 + std::sqrt(1 - std::pow(4 / (4 + kFidelity), 2.f)));
  for (int sweep = 0; sweep < 2 * kSweeps; ++sweep) {
#pragma omp parallel for schedule(static)
    for (int y = 0; y < target.height; ++y) {
      for (int x = (y + sweep) & 1; x < target.width; x += 2) {
        const size_t i = target.at(x, y);
        if (!target.leaf[i]) continue;
        Lanes sum = kFidelity * wanted[i];
        float weight = kFidelity;
        if (x > 0 && target.leaf[i - 1]) sum += value[i - 1] + right[i - 1], weight += 1;
        if (x + 1 < target.width && target.leaf[i + 1]) sum += value[i + 1] - right[i], weight += 1;
        if (y > 0 && target.leaf[i - width]) sum += value[i - width] + down[i - width], weight += 1;
        if (y + 1 < target.height && target.leaf[i + width]) sum += value[i + width] - down[i], weight += 1;
        value[i] += relaxation * (sum / weight - value[i]);
      }
    }
  }
  for (const auto& [x, y] : field.places) {
    PatchPixel& pixel = target.pixels[target.padded(x, y)];
    const Lanes& lanes = value[target.at(x, y)];
    pixel.l = lanes[0], pixel.a = lanes[1], pixel.b = lanes[2];
  }
}

}  // namespace windfall::model
