#include "model/leaf/guided.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <numbers>

#include "kernels/random.h"

namespace windfall::model {

namespace {

constexpr int kRadius = 2, kPatch = 25, kAngles = 64, kBands = 16;
constexpr float kFar = 1e30f;
/// Falloff of the votes with the squared distance from a patch's middle: wide while patches still move, at last so
/// narrow that the example's own sharpness is left.
constexpr float kWide = 0.3f, kSharp = 4.f;
/// A random place must be better by so much than the match that fits to its neighbours': whole pieces of the example
/// look more like a photograph than patches that are each a little better.
constexpr float kRandomGain = 0.4f;
/// Each finer level trusts its colours more and the guides less.
constexpr float kGuideFade = 0.6f;
constexpr int kPiece = 12;          ///< px of the coarsest level: side of the pieces that begin as wholes
constexpr float kFidelity = 0.05f;  ///< of colours beside their steps: seams are spread over 1 / its root, px
constexpr int kLevelSweeps = 30;
constexpr int kFineReach = 32;  ///< px: how far finer levels search

/// Four floats that one instruction adds or multiplies.
using Lanes = float __attribute__((vector_size(16)));
static_assert(sizeof(PatchPixel) == sizeof(Lanes));

Lanes lanesOf(const PatchPixel& pixel) {
  Lanes lanes;
  std::memcpy(&lanes, &pixel, sizeof lanes);
  return lanes;
}

struct Guides {
  Lanes place, kind;
};
static_assert(sizeof(PatchGuide) == sizeof(Guides));

Guides guidesOf(const PatchGuide& guide) {
  Guides guides;
  std::memcpy(&guides, &guide, sizeof guides);
  return guides;
}

struct Match {
  std::int16_t x = -1, y = -1;
  float cost = kFar;
};

/// Offsets in the example's padded picture of a patch that is turned, or mirrored and turned; by row of the patch.
class Offsets {
 public:
  explicit Offsets(int stride) {
    for (int mirrored = 0; mirrored < 2; ++mirrored) {
      for (int angle = 0; angle < kAngles; ++angle) {
        const double turn = 2 * std::numbers::pi * angle / kAngles, c = std::cos(turn), s = std::sin(turn);
        for (int k = 0; k < kPatch; ++k) {
          const int column = k % 5 - kRadius, row = k / 5 - kRadius;
          const double dx = column, dy = mirrored ? -row : row;
          const int x = static_cast<int>(std::lround(c * dx - s * dy)),
                    y = static_cast<int>(std::lround(s * dx + c * dy));
          const auto n = static_cast<size_t>(k);
          step_[index(mirrored, angle)][n] = y * stride + x;
          dx_[index(mirrored, angle)][n] = static_cast<std::int8_t>(x);
          dy_[index(mirrored, angle)][n] = static_cast<std::int8_t>(y);
        }
      }
    }
  }

  /// Which turn takes the target's frame at p to the example's at q.
  static size_t turn(std::uint8_t targetAngle, signed char targetSide, std::uint8_t exampleAngle,
                     signed char exampleSide) {
    const bool mirrored = targetSide != exampleSide;
    const int angle = mirrored ? exampleAngle + targetAngle : exampleAngle - targetAngle;
    return index(mirrored, angle & (kAngles - 1));
  }
  const std::array<int, kPatch>& steps(size_t turn) const { return step_[turn]; }
  /// Any step, turned.
  static std::array<int, 2> turned(size_t turn, int dx, int dy) {
    const bool mirrored = turn >= kAngles;
    const double angle = 2 * std::numbers::pi * static_cast<double>(turn % kAngles) / kAngles;
    const double c = std::cos(angle), s = std::sin(angle), across = mirrored ? -dy : dy;
    return {static_cast<int>(std::lround(c * dx - s * across)), static_cast<int>(std::lround(s * dx + c * across))};
  }
  int dx(size_t turn, size_t k) const { return dx_[turn][k]; }
  int dy(size_t turn, size_t k) const { return dy_[turn][k]; }

 private:
  static size_t index(int mirrored, int angle) { return static_cast<size_t>(mirrored * kAngles + angle); }
  std::array<std::array<int, kPatch>, 2 * kAngles> step_{};
  std::array<std::array<std::int8_t, kPatch>, 2 * kAngles> dx_{}, dy_{};
};

class Level {
 public:
  Level(GuidedLevel& level, double guideWeight, quint64 seed, std::uint32_t number)
      : target_(level.target),
        example_(level.example),
        offsets_(level.example.stride),
        guideWeight_(static_cast<float>(guideWeight) * kPatch * std::pow(kGuideFade, static_cast<float>(number))),
        seed_(seed),
        number_(number),
        field_(target_.leaf.size()),
        whole_(target_.leaf.size()) {
    // A little smooth noise on the target's guides: equal places need not choose equal patches.
    for (int y = 0; y < target_.height; ++y) {
      for (int x = 0; x < target_.width; ++x) {
        const size_t i = target_.at(x, y);
        target_.guides[i].distance += 0.03f * wave(x, y, 1);
        target_.guides[i].margin += 0.015f * wave(x, y, 2);
      }
    }
    for (int y = 0; y < target_.height; ++y) {
      for (int x = 0; x < target_.width; ++x) {
        if (!target_.leaf[target_.at(x, y)]) continue;
        places_.push_back({x, y});
        whole_[target_.at(x, y)] = patchIsWhole(x, y);
      }
    }
  }

  std::vector<Match>& field() { return field_; }

  /// Nearest neighbour in guides normalised within the matched regions.
  void startFromRegions(const std::vector<int>& match) {
    std::vector<std::vector<size_t>> members(1);
    for (size_t i = 0; i < example_.leaf.size(); ++i) {
      if (!example_.leaf[i]) continue;
      const auto region = static_cast<size_t>(std::max(0, example_.region[i]));
      if (region >= members.size()) members.resize(region + 1);
      members[region].push_back(i);
      members[0].push_back(i);
    }
    std::vector<std::vector<size_t>> places(match.size() + 1);
    for (const auto& [x, y] : places_) {
      const int region = target_.region[target_.at(x, y)];
      places[region > 0 && region <= static_cast<int>(match.size()) ? static_cast<size_t>(region) : 0].push_back(
          target_.at(x, y));
    }
    for (size_t r = 0; r < places.size(); ++r) {
      const auto wanted = static_cast<size_t>(r > 0 ? match[r - 1] : 0);
      const std::vector<size_t>& pool =
          wanted > 0 && wanted < members.size() && members[wanted].size() >= 8 ? members[wanted] : members[0];
      assign(places[r], pool);
    }
    keepPiecesWhole();
  }

  void startFromCoarser(const Level& coarser) {
    for (const auto& [x, y] : places_) {
      const int cx = std::min(x / 2, coarser.target_.width - 1), cy = std::min(y / 2, coarser.target_.height - 1);
      Match match = coarser.field_[coarser.target_.at(cx, cy)];
      if (match.x < 0) match = coarser.nearestMatch(cx, cy);
      match.x = static_cast<std::int16_t>(std::clamp(2 * match.x + (x & 1), 0, example_.width - 1));
      match.y = static_cast<std::int16_t>(std::clamp(2 * match.y + (y & 1), 0, example_.height - 1));
      field_[target_.at(x, y)] = match;
    }
  }

  /// Colours from the patches that cover each pixel; `falloff` of the weights with distance from a patch's middle.
  void vote(float falloff) {
    std::array<float, kPatch> weights{};
    for (int k = 0; k < kPatch; ++k) {
      const int dx = k % 5 - kRadius, dy = k / 5 - kRadius;
      weights[static_cast<size_t>(k)] = std::exp(-falloff * static_cast<float>(dx * dx + dy * dy));
    }
    // Where each patch reads and how it is turned, found once and not by each of the pixels that it covers.
    struct Source {
      std::int32_t place = -1;
      std::uint32_t turn = 0;
    };
    std::vector<Source> sources(field_.size());
#pragma omp parallel for schedule(static)
    for (int y = 0; y < target_.height; ++y) {
      for (int x = 0; x < target_.width; ++x) {
        const Match& match = field_[target_.at(x, y)];
        if (match.x < 0) continue;
        sources[target_.at(x, y)] = {static_cast<std::int32_t>(example_.padded(match.x, match.y)),
                                     static_cast<std::uint32_t>(turnOf(x, y, match.x, match.y))};
      }
    }
    std::vector<PatchPixel> result = target_.pixels;
#pragma omp parallel for schedule(dynamic, 4)
    for (int y = 0; y < target_.height; ++y) {
      for (int x = 0; x < target_.width; ++x) {
        if (!target_.leaf[target_.at(x, y)]) continue;
        Lanes sum{};
        float total = 0;
        for (int k = 0; k < kPatch; ++k) {
          const int px = x - (k % 5 - kRadius), py = y - (k / 5 - kRadius);
          if (px < 0 || py < 0 || px >= target_.width || py >= target_.height) continue;
          const Source& source = sources[target_.at(px, py)];
          if (source.place < 0) continue;
          const int steps = offsets_.steps(source.turn)[static_cast<size_t>(k)];
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
    const std::vector<Match> before = field_;
#pragma omp parallel for schedule(dynamic, 1)
    for (int band = 0; band < kBands; ++band) {
      const int top = target_.height * band / kBands, bottom = target_.height * (band + 1) / kBands;
      for (int y = top; y < bottom; ++y) {
        for (int x = 0; x < target_.width; ++x) {
          if (target_.leaf[target_.at(x, y)])
            field_[target_.at(x, y)].cost = cost(x, y, field_[target_.at(x, y)].x, field_[target_.at(x, y)].y, kFar);
        }
      }
      for (int scan = 0; scan < 2; ++scan) {
        const int step = scan == 0 ? -1 : 1;
        for (int n = 0; n < bottom - top; ++n) {
          const int y = scan == 0 ? top + n : bottom - 1 - n;
          for (int m = 0; m < target_.width; ++m) {
            const int x = scan == 0 ? m : target_.width - 1 - m;
            if (!target_.leaf[target_.at(x, y)]) continue;
            Match& best = field_[target_.at(x, y)];
            takeOver(best, x, y, x + step, y, field_);
            takeOver(best, x, y, x, y + step, y + step >= top && y + step < bottom ? field_ : before);
            if (scan == 1) tryRandom(best, x, y, round);
          }
        }
      }
    }
  }

  /// Colours whose steps from pixel to pixel are those of the example, at small cost in the colours themselves: where
  /// two patches of different brightness meet, the step between them is spread out instead of seen as an edge.
  void levelSeams(float fidelity, int sweeps) {
    const size_t count = target_.leaf.size();
    const auto width = static_cast<size_t>(target_.width);
    std::vector<Lanes> right(count, Lanes{}), down(count, Lanes{}), value(count, Lanes{});
#pragma omp parallel for schedule(static)
    for (int y = 0; y < target_.height; ++y) {
      for (int x = 0; x < target_.width; ++x) {
        const size_t i = target_.at(x, y);
        if (!target_.leaf[i]) continue;
        value[i] = lanesOf(target_.pixels[target_.padded(x, y)]);
        if (x + 1 < target_.width && target_.leaf[i + 1]) right[i] = step(x, y, 1, 0);
        if (y + 1 < target_.height && target_.leaf[i + width]) down[i] = step(x, y, 0, 1);
      }
    }
    const std::vector<Lanes> wanted = value;
    // Successive over-relaxation, red and black pixels in turn: the same bits for any number of threads.
    const float relaxation = 2 / (1 + std::sqrt(1 - std::pow(4 / (4 + fidelity), 2.f)));
    for (int sweep = 0; sweep < 2 * sweeps; ++sweep) {
#pragma omp parallel for schedule(static)
      for (int y = 0; y < target_.height; ++y) {
        for (int x = (y + sweep) & 1; x < target_.width; x += 2) {
          const size_t i = target_.at(x, y);
          if (!target_.leaf[i]) continue;
          Lanes sum = fidelity * wanted[i];
          float weight = fidelity;
          if (x > 0 && target_.leaf[i - 1]) sum += value[i - 1] + right[i - 1], weight += 1;
          if (x + 1 < target_.width && target_.leaf[i + 1]) sum += value[i + 1] - right[i], weight += 1;
          if (y > 0 && target_.leaf[i - width]) sum += value[i - width] + down[i - width], weight += 1;
          if (y + 1 < target_.height && target_.leaf[i + width]) sum += value[i + width] - down[i], weight += 1;
          value[i] += relaxation * (sum / weight - value[i]);
        }
      }
    }
    for (const auto& [x, y] : places_) {
      PatchPixel& pixel = target_.pixels[target_.padded(x, y)];
      const Lanes& lanes = value[target_.at(x, y)];
      pixel.l = lanes[0], pixel.a = lanes[1], pixel.b = lanes[2];
    }
  }

  std::vector<float> colours() const {
    std::vector<float> result(3 * target_.leaf.size(), 0.f);
    for (const auto& [x, y] : places_) {
      const PatchPixel& pixel = target_.pixels[target_.padded(x, y)];
      float* out = &result[3 * target_.at(x, y)];
      out[0] = pixel.l, out[1] = pixel.a, out[2] = pixel.b;
    }
    return result;
  }

 private:
  struct Place {
    int x, y;
  };

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

  /// The step of the colours from a pixel to the next one, as far as one of their two patches has the like of it.
  Lanes step(int x, int y, int dx, int dy) const {
    Lanes least{kFar, kFar, kFar, kFar}, most = -least;
    const auto add = [&](int px, int py, int way) {
      const Match& match = field_[target_.at(px, py)];
      if (match.x < 0) return;
      const auto k = static_cast<size_t>((way * dy + kRadius) * 5 + way * dx + kRadius);
      const size_t middle = example_.padded(match.x, match.y);
      const int offset = offsets_.steps(turnOf(px, py, match.x, match.y))[k];
      const PatchPixel& beside = example_.pixels[static_cast<size_t>(static_cast<int>(middle) + offset)];
      if (beside.penalty > 0) return;
      const Lanes step = static_cast<float>(way) * (lanesOf(beside) - lanesOf(example_.pixels[middle]));
      least = step < least ? step : least;
      most = step > most ? step : most;
    };
    add(x, y, 1);
    add(x + dx, y + dy, -1);
    if (least[0] > most[0]) return Lanes{};
    const Lanes own =
        lanesOf(target_.pixels[target_.padded(x + dx, y + dy)]) - lanesOf(target_.pixels[target_.padded(x, y)]);
    const Lanes above = own < least ? least : own;
    return above > most ? most : above;
  }

  bool patchIsWhole(int x, int y) const {
    for (int dy = -kRadius; dy <= kRadius; ++dy) {
      for (int dx = -kRadius; dx <= kRadius; ++dx) {
        if (target_.pixels[target_.padded(x + dx, y + dy)].penalty > 0) return false;
      }
    }
    return true;
  }

  size_t turnOf(int x, int y, int ex, int ey) const {
    const size_t t = target_.at(x, y), e = example_.at(ex, ey);
    return Offsets::turn(target_.angle[t], target_.side[t], example_.angle[e], example_.side[e]);
  }

  /// Cost of a match; stops early above `limit`.
  float cost(int x, int y, int ex, int ey, float limit) const {
    if (ex < 0) return kFar;
    const size_t t = target_.at(x, y), e = example_.at(ex, ey);
    if (!example_.leaf[e]) return kFar;
    const Guides g = guidesOf(target_.guides[t]), h = guidesOf(example_.guides[e]);
    const Lanes place = g.place - h.place, kind = g.kind - h.kind, guides = place * place + kind * kind;
    float sum = guideWeight_ * ((guides[0] + guides[1]) + (guides[2] + guides[3]));
    if (sum >= limit) return sum;
    const std::array<int, kPatch>& steps = offsets_.steps(turnOf(x, y, ex, ey));
    const PatchPixel* from = &example_.pixels[example_.padded(ex, ey)];
    const PatchPixel* to = &target_.pixels[target_.padded(x, y)];
    const bool whole = whole_[t] != 0;
    for (int row = 0; row < 5; ++row) {
      const PatchPixel* across = to + (row - kRadius) * target_.stride - kRadius;
      const int* step = &steps[static_cast<size_t>(5 * row)];
      Lanes squares{};
      for (int k = 0; k < 5; ++k) {
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

  void offer(Match& best, int x, int y, int ex, int ey, float keep = 1) const {
    if (ex < 0 || ey < 0 || ex >= example_.width || ey >= example_.height) return;
    const float c = cost(x, y, ex, ey, best.cost * keep);
    if (c < best.cost * keep) best = {static_cast<std::int16_t>(ex), static_cast<std::int16_t>(ey), c};
  }

  /// The neighbour's match, moved by the step between them as its frame turns it.
  void takeOver(Match& best, int x, int y, int nx, int ny, const std::vector<Match>& matches) const {
    if (nx < 0 || ny < 0 || nx >= target_.width || ny >= target_.height) return;
    const Match& match = matches[target_.at(nx, ny)];
    if (match.x < 0) return;
    const size_t turn = turnOf(nx, ny, match.x, match.y);
    const auto k = static_cast<size_t>((y - ny + kRadius) * 5 + (x - nx + kRadius));
    offer(best, x, y, match.x + offsets_.dx(turn, k), match.y + offsets_.dy(turn, k));
  }

  void tryRandom(Match& best, int x, int y, std::uint32_t round) const {
    std::uint32_t bits = hash(seed_, number_ * 64 + round, static_cast<std::uint32_t>(target_.at(x, y)), 77);
    // Far places were tried on the coarser levels, where each try is worth more.
    const int widest = std::max(example_.width, example_.height) / 2;
    for (int radius = number_ == 0 ? widest : std::min(widest, kFineReach); radius >= 1; radius /= 2) {
      bits = pcg(bits);
      const int dx = static_cast<int>(bits % static_cast<std::uint32_t>(2 * radius + 1)) - radius;
      bits = pcg(bits);
      const int dy = static_cast<int>(bits % static_cast<std::uint32_t>(2 * radius + 1)) - radius;
      offer(best, x, y, best.x + dx, best.y + dy, kRandomGain);
    }
  }

  Match nearestMatch(int x, int y) const {
    for (int reach = 1; reach < std::max(target_.width, target_.height); ++reach) {
      for (int dy = -reach; dy <= reach; ++dy) {
        for (int dx = -reach; dx <= reach; ++dx) {
          const int nx = x + dx, ny = y + dy;
          if (std::max(std::abs(dx), std::abs(dy)) != reach || nx < 0 || ny < 0 || nx >= target_.width ||
              ny >= target_.height)
            continue;
          if (field_[target_.at(nx, ny)].x >= 0) return field_[target_.at(nx, ny)];
        }
      }
    }
    return {0, 0, kFar};
  }

  /// Small pieces of the target take over the match of their middle: a region that is larger than the example's is
  /// filled with its pieces in their own size instead of one that is stretched.
  void keepPiecesWhole() {
    const std::vector<Match> single = field_;
    for (const auto& [x, y] : places_) {
      const int cx = std::min(target_.width - 1, x / kPiece * kPiece + kPiece / 2),
                cy = std::min(target_.height - 1, y / kPiece * kPiece + kPiece / 2);
      const size_t here = target_.at(x, y), middle = target_.at(cx, cy);
      const Match& match = single[middle];
      if (match.x < 0 || target_.region[middle] != target_.region[here]) continue;
      const auto [dx, dy] = Offsets::turned(turnOf(cx, cy, match.x, match.y), x - cx, y - cy);
      const int ex = match.x + dx, ey = match.y + dy;
      if (ex < 0 || ey < 0 || ex >= example_.width || ey >= example_.height) continue;
      const size_t e = example_.at(ex, ey);
      if (!example_.leaf[e] || example_.region[e] != example_.region[example_.at(match.x, match.y)]) continue;
      field_[here] = {static_cast<std::int16_t>(ex), static_cast<std::int16_t>(ey), kFar};
    }
  }

  void assign(const std::vector<size_t>& places, const std::vector<size_t>& pool) {
    if (pool.empty()) return;
    struct Range {
      std::array<float, 3> low{kFar, kFar, kFar}, high{-kFar, -kFar, -kFar};
      void add(const PatchGuide& g) {
        const std::array<float, 3> v{g.distance, g.vein, g.margin};
        for (size_t c = 0; c < 3; ++c) low[c] = std::min(low[c], v[c]), high[c] = std::max(high[c], v[c]);
      }
      std::array<float, 3> of(const PatchGuide& g) const {
        const std::array<float, 3> v{g.distance, g.vein, g.margin};
        std::array<float, 3> result{};
        for (size_t c = 0; c < 3; ++c) result[c] = high[c] > low[c] ? (v[c] - low[c]) / (high[c] - low[c]) : 0.5f;
        return result;
      }
    };
    Range to, from;
    for (const size_t i : places) to.add(target_.guides[i]);
    for (const size_t i : pool) from.add(example_.guides[i]);
    std::vector<std::array<float, 3>> known;
    for (const size_t i : pool) known.push_back(from.of(example_.guides[i]));
    // Large pools are thinned: the search that follows refines.
    const size_t stride = std::max<size_t>(1, known.size() / 1500);
#pragma omp parallel for schedule(static)
    for (size_t n = 0; n < places.size(); ++n) {
      const std::array<float, 3> wanted = to.of(target_.guides[places[n]]);
      float best = kFar;
      size_t chosen = 0;
      for (size_t k = n % stride; k < known.size(); k += stride) {
        const float a = wanted[0] - known[k][0], b = wanted[1] - known[k][1], c = wanted[2] - known[k][2];
        const float d = a * a + b * b + c * c;
        if (d < best) best = d, chosen = k;
      }
      const size_t e = pool[chosen];
      field_[places[n]] = {static_cast<std::int16_t>(e % static_cast<size_t>(example_.width)),
                           static_cast<std::int16_t>(e / static_cast<size_t>(example_.width)), kFar};
    }
  }

  PatchImage& target_;
  const PatchImage& example_;
  Offsets offsets_;
  float guideWeight_;
  quint64 seed_;
  std::uint32_t number_;
  std::vector<Match> field_;
  std::vector<std::uint8_t> whole_;  ///< the patch lies on the leaf altogether
  std::vector<Place> places_;
};

}  // namespace

std::vector<float> synthesizeGuided(std::vector<GuidedLevel> levels, const std::vector<int>& match, double guideWeight,
                                    quint64 seed, Progress& progress) {
  std::unique_ptr<Level> coarser;
  for (size_t n = 0; n < levels.size(); ++n) {
    auto level = std::make_unique<Level>(levels[n], guideWeight, seed, static_cast<std::uint32_t>(n));
    if (coarser) {
      level->startFromCoarser(*coarser);
    } else {
      level->startFromRegions(match);
    }
    level->vote(kWide);
    const int rounds = n == 0 ? 4 : n == 1 ? 3 : 2;
    for (int round = 0; round < rounds; ++round) {
      if (progress.cancelled()) return {};
      level->search(static_cast<std::uint32_t>(round));
      const bool last = n + 1 == levels.size() && round + 1 == rounds;
      level->vote(last ? kSharp : kWide);
    }
    if (n + 1 == levels.size()) level->levelSeams(kFidelity, kLevelSweeps);
    progress.report(static_cast<double>(n + 1) / static_cast<double>(levels.size()));
    coarser = std::move(level);
  }
  return coarser ? coarser->colours() : std::vector<float>{};
}

}  // namespace windfall::model
