#include <algorithm>
#include <cmath>

#include "model/leaf/guided_private.h"

namespace windfall::model {

namespace {

constexpr int kPiece = 12;          ///< px of the coarsest level: side of the pieces that begin as wholes
constexpr float kFollow = 0.4f;     ///< how far the target's distances become those of the matched regions
constexpr size_t kLeastRegion = 8;  ///< px of a region that can lend anything
constexpr size_t kLargestPool = 1500;

struct Span {
  float low = kNoMatch, high = -kNoMatch;
  void add(float value) { low = std::min(low, value), high = std::max(high, value); }
  float share(float value) const { return high > low ? std::clamp((value - low) / (high - low), 0.f, 1.f) : 0.5f; }
};

/// From where to where the structural distances of each region reach, but for 2 % at either end.
std::vector<Span> distanceSpans(const PatchImage& image) {
  std::vector<std::vector<float>> values;
  for (size_t i = 0; i < image.leaf.size(); ++i) {
    if (!image.leaf[i] || image.region[i] <= 0) continue;
    const auto region = static_cast<size_t>(image.region[i]);
    if (region >= values.size()) values.resize(region + 1);
    values[region].push_back(image.guides[i].distance);
  }
  std::vector<Span> spans(values.size());
  for (size_t r = 0; r < values.size(); ++r) {
    std::vector<float>& list = values[r];
    if (list.empty()) continue;
    const size_t ends = list.size() / 50;
    const auto place = [&](size_t n) {
      const auto at = list.begin() + static_cast<std::ptrdiff_t>(n);
      std::nth_element(list.begin(), at, list.end());
      return *at;
    };
    spans[r] = {place(ends), place(list.size() - 1 - ends)};
  }
  return spans;
}

/// Small pieces of the target take over the match of their middle: a region that is larger than the example's is filled
/// with its pieces in their own size instead of one that is stretched.
void keepPiecesWhole(PatchField& field) {
  const PatchImage &target = field.target, &example = field.example;
  const std::vector<PatchMatch> single = field.matches;
  for (const auto& [x, y] : field.places) {
    const int cx = std::min(target.width - 1, x / kPiece * kPiece + kPiece / 2),
              cy = std::min(target.height - 1, y / kPiece * kPiece + kPiece / 2);
    const size_t here = target.at(x, y), middle = target.at(cx, cy);
    const PatchMatch& match = single[middle];
    if (!match.exists() || target.region[middle] != target.region[here]) continue;
    const auto [dx, dy] = field.turns.turned(match.turn, static_cast<float>(x - cx), static_cast<float>(y - cy));
    const PatchMatch moved{match.x + dx, match.y + dy, kNoMatch, match.turn};
    if (!field.inside(moved)) continue;
    const size_t e = example.at(moved.column(), moved.row());
    if (!example.leaf[e] || example.region[e] != example.region[example.at(match.column(), match.row())]) continue;
    field.matches[here] = moved;
  }
}

/// Places and pool: pixels of target and example.
void assign(PatchField& field, const std::vector<size_t>& places, const std::vector<size_t>& pool) {
  if (pool.empty()) return;
  using Shares = std::array<float, 3>;
  struct Range {
    std::array<Span, 3> spans;
    static Shares valuesOf(const PatchGuide& g) { return {g.distance, g.vein, g.margin}; }
    void add(const PatchGuide& g) {
      const Shares values = valuesOf(g);
      for (size_t c = 0; c < 3; ++c) spans[c].add(values[c]);
    }
    Shares of(const PatchGuide& g) const {
      Shares values = valuesOf(g);
      for (size_t c = 0; c < 3; ++c) values[c] = spans[c].share(values[c]);
      return values;
    }
  };
  Range to, from;
  for (const size_t i : places) to.add(field.target.guides[i]);
  for (const size_t i : pool) from.add(field.example.guides[i]);
  std::vector<Shares> known;
  for (const size_t i : pool) known.push_back(from.of(field.example.guides[i]));
  // Large pools are thinned: the search that follows refines.
  const size_t stride = std::max<size_t>(1, known.size() / kLargestPool);
  const auto width = static_cast<size_t>(field.target.width), exampleWidth = static_cast<size_t>(field.example.width);
#pragma omp parallel for schedule(static)
  for (size_t n = 0; n < places.size(); ++n) {
    const Shares wanted = to.of(field.target.guides[places[n]]);
    float best = kNoMatch;
    size_t chosen = 0;
    for (size_t k = n % stride; k < known.size(); k += stride) {
      const float a = wanted[0] - known[k][0], b = wanted[1] - known[k][1], c = wanted[2] - known[k][2];
      const float d = a * a + b * b + c * c;
      if (d < best) best = d, chosen = k;
    }
    const size_t e = pool[chosen];
    field.matches[places[n]] = field.placed(static_cast<int>(places[n] % width), static_cast<int>(places[n] / width),
                                            static_cast<int>(e % exampleWidth), static_cast<int>(e / exampleWidth));
  }
}

PatchMatch nearestMatch(const PatchField& field, int x, int y) {
  const PatchImage& target = field.target;
  for (int reach = 1; reach < std::max(target.width, target.height); ++reach) {
    for (int dy = -reach; dy <= reach; ++dy) {
      for (int dx = -reach; dx <= reach; ++dx) {
        const int nx = x + dx, ny = y + dy;
        if (std::max(std::abs(dx), std::abs(dy)) != reach || nx < 0 || ny < 0 || nx >= target.width ||
            ny >= target.height)
          continue;
        if (field.matches[target.at(nx, ny)].exists()) return field.matches[target.at(nx, ny)];
      }
    }
  }
  return {0, 0, kNoMatch, 0};
}

}  // namespace

void followRegions(PatchField& field, const std::vector<int>& match) {
  const std::vector<Span> own = distanceSpans(field.target), its = distanceSpans(field.example);
  for (size_t i = 0; i < field.target.leaf.size(); ++i) {
    const int region = field.target.region[i];
    if (!field.target.leaf[i] || region <= 0 || region > static_cast<int>(match.size())) continue;
    const auto from = static_cast<size_t>(match[static_cast<size_t>(region - 1)]);
    if (from == 0 || from >= its.size() || its[from].high < its[from].low) continue;
    float& distance = field.target.guides[i].distance;
    const float along = own[static_cast<size_t>(region)].share(distance);
    distance += kFollow * (its[from].low + along * (its[from].high - its[from].low) - distance);
  }
}

void startFromRegions(PatchField& field, const std::vector<int>& match) {
  const PatchImage &target = field.target, &example = field.example;
  std::vector<std::vector<size_t>> members(1);
  for (size_t i = 0; i < example.leaf.size(); ++i) {
    if (!example.leaf[i]) continue;
    const auto region = static_cast<size_t>(std::max(0, example.region[i]));
    if (region >= members.size()) members.resize(region + 1);
    members[region].push_back(i);
    members[0].push_back(i);
  }
  std::vector<std::vector<size_t>> places(match.size() + 1);
  for (const auto& [x, y] : field.places) {
    const int region = target.region[target.at(x, y)];
    places[region > 0 && region <= static_cast<int>(match.size()) ? static_cast<size_t>(region) : 0].push_back(
        target.at(x, y));
  }
  for (size_t r = 0; r < places.size(); ++r) {
    const auto wanted = static_cast<size_t>(r > 0 ? match[r - 1] : 0);
    const bool known = wanted > 0 && wanted < members.size() && members[wanted].size() >= kLeastRegion;
    assign(field, places[r], members[known ? wanted : 0]);
  }
  keepPiecesWhole(field);
}

void startFromCoarser(PatchField& field, const PatchField& coarser) {
  for (const auto& [x, y] : field.places) {
    const int cx = std::min(x / 2, coarser.target.width - 1), cy = std::min(y / 2, coarser.target.height - 1);
    PatchMatch match = coarser.matches[coarser.target.at(cx, cy)];
    if (!match.exists()) match = nearestMatch(coarser, cx, cy);
    const auto [dx, dy] =
        field.turns.turned(match.turn, static_cast<float>(x & 1) - 0.5f, static_cast<float>(y & 1) - 0.5f);
    match.x = std::clamp(2 * match.x + 0.5f + dx, 0.f, static_cast<float>(field.example.width - 1));
    match.y = std::clamp(2 * match.y + 0.5f + dy, 0.f, static_cast<float>(field.example.height - 1));
    field.matches[field.target.at(x, y)] = match;
  }
}

}  // namespace windfall::model
