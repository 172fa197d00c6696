#include "model/leaf/guided.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "kernels/random.h"
#include "model/leaf/guided_private.h"

namespace windfall::model {

namespace {

constexpr int kBands = 16;
/// Falloff of the votes with the squared distance from a patch's middle: wide while patches still move, at last so
/// narrow that the example's own sharpness is left.
constexpr float kWide = 1, kSharp = 4;
/// A random place must be better by so much than the match that fits to its neighbours': whole pieces of the example
/// look more like a photograph than patches that are each a little better.
constexpr float kRandomGain = 0.4f;
/// Each finer level trusts its colours more and the guides less.
constexpr float kGuideFade = 0.6f;
/// Cost, in squared guides, of a piece that lies otherwise to the veins than it did: times 1 - cos of the angle
/// between, and for the wrong side of the leaf. So much is worth a piece that stays whole where the veins bend.
constexpr float kBend = 0.3f, kMirrored = 0.02f;
constexpr int kFineReach = 32;  ///< px: how far finer levels search

struct Guides {
  Lanes place, kind;
};
static_assert(sizeof(PatchGuide) == sizeof(Guides));

Guides guidesOf(const PatchGuide& guide) {
  Guides guides;
  std::memcpy(&guides, &guide, sizeof guides);
  return guides;
}

class Level {
 public:
  Level(GuidedLevel& level, double guideWeight, quint64 seed, std::uint32_t number)
      : target_(level.target),
        example_(level.example),
        guideWeight_(static_cast<float>(guideWeight) * kPatchPixels * std::pow(kGuideFade, static_cast<float>(number))),
        seed_(seed),
        number_(number),
        field_(level.target, level.example),
        whole_(target_.leaf.size()) {
    // A little smooth noise on the target's guides: equal places need not choose equal patches.
    for (int y = 0; y < target_.height; ++y) {
      for (int x = 0; x < target_.width; ++x) {
        const size_t i = target_.at(x, y);
        target_.guides[i].distance += 0.03f * wave(x, y, 1);
        target_.guides[i].margin += 0.015f * wave(x, y, 2);
      }
    }
    for (const auto& [x, y] : field_.places) whole_[target_.at(x, y)] = patchIsWhole(x, y);
  }

  PatchField& field() { return field_; }

  /// Colours from the patches that cover each pixel; `falloff` of the weights with distance from a patch's middle.
  void vote(float falloff) {
    std::array<float, kPatchPixels> weights{};
    for (int k = 0; k < kPatchPixels; ++k) {
      const int dx = k % kPatchSide - kPatchRadius, dy = k / kPatchSide - kPatchRadius;
      weights[static_cast<size_t>(k)] = std::exp(-falloff * static_cast<float>(dx * dx + dy * dy));
    }
    // Where each patch reads and how it is turned, found once and not by each of the pixels that it covers.
    struct Source {
      std::int32_t place = -1;
      std::uint32_t turn = 0;
    };
    std::vector<Source> sources(field_.matches.size());
#pragma omp parallel for schedule(static)
    for (int y = 0; y < target_.height; ++y) {
      for (int x = 0; x < target_.width; ++x) {
        const PatchMatch& match = field_.matches[target_.at(x, y)];
        if (!match.exists()) continue;
        sources[target_.at(x, y)] = {static_cast<std::int32_t>(example_.padded(match.column(), match.row())),
                                     match.turn};
      }
    }
    std::vector<PatchPixel> result = target_.pixels;
#pragma omp parallel for schedule(dynamic, 4)
    for (int y = 0; y < target_.height; ++y) {
      for (int x = 0; x < target_.width; ++x) {
        if (!target_.leaf[target_.at(x, y)]) continue;
        Lanes sum{};
        float total = 0;
        for (int k = 0; k < kPatchPixels; ++k) {
          const int px = x - (k % kPatchSide - kPatchRadius), py = y - (k / kPatchSide - kPatchRadius);
          if (px < 0 || py < 0 || px >= target_.width || py >= target_.height) continue;
          const Source& source = sources[target_.at(px, py)];
          if (source.place < 0) continue;
          const int steps = field_.turns.steps(source.turn)[static_cast<size_t>(k)];
          const PatchPixel& pixel = example_.pixels[static_cast<size_t>(source.place + steps)];
          if (pixel.penalty > 0) continue;
          const float weight = weights[static_cast<size_t>(k)];
          sum += weight * lanesOf(pixel);
          total += weight;
        }
        if (total > 0) {
          PatchPixel& pixel = result[target_.padded(x, y)];
          pixel.l = sum[0] / total, pixel.a = sum[1] / total, pixel.b = sum[2] / total;
        }
      }
    }
    target_.pixels.swap(result);
  }

  /// One search: two scans that take over neighbours' matches, then random tries in shrinking windows. Bands of rows
  /// are independent: beyond their border they see the matches of before.
  void search(std::uint32_t round) {
    std::vector<PatchMatch>& matches = field_.matches;
    const std::vector<PatchMatch> before = matches;
#pragma omp parallel for schedule(dynamic, 1)
    for (int band = 0; band < kBands; ++band) {
      const int top = target_.height * band / kBands, bottom = target_.height * (band + 1) / kBands;
      for (int y = top; y < bottom; ++y) {
        for (int x = 0; x < target_.width; ++x) {
          if (!target_.leaf[target_.at(x, y)]) continue;
          PatchMatch& match = matches[target_.at(x, y)];
          match.cost = cost(x, y, match, kNoMatch);
        }
      }
      for (int scan = 0; scan < 2; ++scan) {
        const int step = scan == 0 ? -1 : 1;
        for (int n = 0; n < bottom - top; ++n) {
          const int y = scan == 0 ? top + n : bottom - 1 - n;
          for (int m = 0; m < target_.width; ++m) {
            const int x = scan == 0 ? m : target_.width - 1 - m;
            if (!target_.leaf[target_.at(x, y)]) continue;
            PatchMatch& best = matches[target_.at(x, y)];
            takeOver(best, x, y, x + step, y, matches);
            takeOver(best, x, y, x, y + step, y + step >= top && y + step < bottom ? matches : before);
            if (scan == 1) tryRandom(best, x, y, round);
          }
        }
      }
    }
  }

  std::vector<float> colours() const {
    std::vector<float> result(3 * target_.leaf.size(), 0.f);
    for (const auto& [x, y] : field_.places) {
      const PatchPixel& pixel = target_.pixels[target_.padded(x, y)];
      float* out = &result[3 * target_.at(x, y)];
      out[0] = pixel.l, out[1] = pixel.a, out[2] = pixel.b;
    }
    return result;
  }

 private:
  /// Smooth noise of a few pixels' scale, -1..1.
  float wave(int x, int y, std::uint32_t stream) const {
    constexpr int kCell = 12;
    const auto value = [&](int cx, int cy) {
      return 2 * uniform(seed_, 900 + stream, static_cast<std::uint32_t>(cx), static_cast<std::uint32_t>(cy)) - 1;
    };
    const int cx = x / kCell, cy = y / kCell;
    const float fx = static_cast<float>(x % kCell) / kCell, fy = static_cast<float>(y % kCell) / kCell;
    const float top = value(cx, cy) * (1 - fx) + value(cx + 1, cy) * fx;
    const float bottom = value(cx, cy + 1) * (1 - fx) + value(cx + 1, cy + 1) * fx;
    return top * (1 - fy) + bottom * fy;
  }

  bool patchIsWhole(int x, int y) const {
    for (int dy = -kPatchRadius; dy <= kPatchRadius; ++dy) {
      for (int dx = -kPatchRadius; dx <= kPatchRadius; ++dx) {
        if (target_.pixels[target_.padded(x + dx, y + dy)].penalty > 0) return false;
      }
    }
    return true;
  }

  /// How unlike a match's turn is to the one between the two frames, in squared guides.
  float bend(size_t t, size_t e, std::uint32_t turn) const {
    const bool mirrored = PatchTurns::isMirrored(turn);
    const std::uint32_t wanted = PatchTurns::between(mirrored, target_.angle[t], example_.angle[e]);
    const float cosine = field_.turns.cosine(static_cast<int>(turn) - static_cast<int>(wanted));
    const bool wrongSide = mirrored != (target_.side[t] != example_.side[e]);
    return kBend * (1 - cosine) + (wrongSide ? kMirrored : 0.f);
  }

  /// Cost of a match; stops early above `limit`.
  float cost(int x, int y, const PatchMatch& match, float limit) const {
    if (!match.exists()) return kNoMatch;
    const size_t t = target_.at(x, y), e = example_.at(match.column(), match.row());
    if (!example_.leaf[e]) return kNoMatch;
    const Guides g = guidesOf(target_.guides[t]), h = guidesOf(example_.guides[e]);
    const Lanes place = g.place - h.place, kind = g.kind - h.kind, guides = place * place + kind * kind;
    float sum = guideWeight_ * ((guides[0] + guides[1]) + (guides[2] + guides[3]) + bend(t, e, match.turn));
    if (sum >= limit) return sum;
    const std::array<int, kPatchPixels>& steps = field_.turns.steps(match.turn);
    const PatchPixel* from = &example_.pixels[example_.padded(match.column(), match.row())];
    const PatchPixel* to = &target_.pixels[target_.padded(x, y)];
    const bool whole = whole_[t] != 0;
    for (int row = 0; row < kPatchSide; ++row) {
      const PatchPixel* across = to + (row - kPatchRadius) * target_.stride - kPatchRadius;
      const int* step = &steps[static_cast<size_t>(kPatchSide * row)];
      Lanes squares{};
      for (int k = 0; k < kPatchSide; ++k) {
        // Where the target itself is off its leaf nothing is compared.
        if (!whole && across[k].penalty > 0) continue;
        const Lanes difference = lanesOf(across[k]) - lanesOf(from[step[k]]);
        squares += difference * difference;
      }
      sum += (squares[0] + squares[1]) + (squares[2] + squares[3]);
      if (sum >= limit) return sum;
    }
    return sum;
  }

  void offer(PatchMatch& best, int x, int y, PatchMatch match, float keep = 1) const {
    if (!field_.inside(match)) return;
    match.cost = cost(x, y, match, best.cost * keep);
    if (match.cost < best.cost * keep) best = match;
  }

  /// The neighbour's match, moved by the step between them as it is turned.
  void takeOver(PatchMatch& best, int x, int y, int nx, int ny, const std::vector<PatchMatch>& matches) const {
    if (nx < 0 || ny < 0 || nx >= target_.width || ny >= target_.height) return;
    const PatchMatch& match = matches[target_.at(nx, ny)];
    if (!match.exists()) return;
    const auto [dx, dy] = field_.turns.turned(match.turn, static_cast<float>(x - nx), static_cast<float>(y - ny));
    offer(best, x, y, {match.x + dx, match.y + dy, kNoMatch, match.turn});
  }

  void tryRandom(PatchMatch& best, int x, int y, std::uint32_t round) const {
    std::uint32_t bits = hash(seed_, number_ * 64 + round, static_cast<std::uint32_t>(target_.at(x, y)), 77);
    // Far places were tried on the coarser levels, where each try is worth more.
    const int widest = std::max(example_.width, example_.height) / 2;
    for (int radius = number_ == 0 ? widest : std::min(widest, kFineReach); radius >= 1; radius /= 2) {
      bits = pcg(bits);
      const int dx = static_cast<int>(bits % static_cast<std::uint32_t>(2 * radius + 1)) - radius;
      bits = pcg(bits);
      const int dy = static_cast<int>(bits % static_cast<std::uint32_t>(2 * radius + 1)) - radius;
      const int ex = best.column() + dx, ey = best.row() + dy;
      if (ex < 0 || ey < 0 || ex >= example_.width || ey >= example_.height) continue;
      offer(best, x, y, field_.placed(x, y, ex, ey), kRandomGain);
    }
  }

  PatchImage& target_;
  const PatchImage& example_;
  float guideWeight_;
  quint64 seed_;
  std::uint32_t number_;
  PatchField field_;
  std::vector<std::uint8_t> whole_;  ///< the patch lies on the leaf altogether
};

}  // namespace

std::vector<float> synthesizeGuided(std::vector<GuidedLevel> levels, const std::vector<int>& match, double guideWeight,
                                    quint64 seed, Progress& progress) {
  std::unique_ptr<Level> coarser;
  for (size_t n = 0; n < levels.size(); ++n) {
    auto level = std::make_unique<Level>(levels[n], guideWeight, seed, static_cast<std::uint32_t>(n));
    followRegions(level->field(), match);
    if (coarser) {
      startFromCoarser(level->field(), coarser->field());
    } else {
      startFromRegions(level->field(), match);
    }
    level->vote(kWide);
    const int rounds = n == 0 ? 4 : n == 1 ? 3 : 2;
    for (int round = 0; round < rounds; ++round) {
      if (progress.cancelled()) return {};
      chargeUse(level->field());
      level->search(static_cast<std::uint32_t>(round));
      const bool last = n + 1 == levels.size() && round + 1 == rounds;
      level->vote(last ? kSharp : kWide);
    }
    if (n + 1 == levels.size()) levelSeams(level->field());
    progress.report(static_cast<double>(n + 1) / static_cast<double>(levels.size()));
    coarser = std::move(level);
  }
  return coarser ? coarser->colours() : std::vector<float>{};
}

}  // namespace windfall::model
