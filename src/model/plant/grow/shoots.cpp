#include "model/plant/grow/shoots.h"

#include <algorithm>
#include <cmath>

#include "model/plant/grow/draw.h"

namespace windfall::model::growth {

namespace {

enum Question : std::uint64_t { kLength = 71, kBears, kJitter, kFalls = 81, kWear };
constexpr double kOverGround = 0.5;

}  // namespace

void hangShoots(Grown& grown, const ColonizationSettings& s, double size, quint64 seed) {
  if (!(s.hangingLength > 0) || !(s.hangingStep > 0.01)) return;
  const std::vector<std::vector<int>> children = childrenOf(grown);
  const std::size_t count = grown.size();
  for (std::size_t i = 1; i < count; ++i) {
    const auto who = static_cast<std::uint64_t>(grown.source[i]);
    const bool tip = children[i].empty();
    if (!tip && (grown.radius[i] >= 0.03 || draw(seed, who, kBears) >= s.hangingShare)) continue;
    const double length = s.hangingLength * size * (0.4 + 0.6 * draw(seed, who, kLength));
    const dvec3 along = grown.position[i] - grown.position[at(grown.parent[i])];
    dvec3 direction = along / std::max(glm::length(along), 1e-9);
    if (!tip) {
      // Leaves its twig sideways before it falls.
      const dvec3 out(draw(seed, who, kJitter + 7) - 0.5, 0, draw(seed, who, kJitter + 8) - 0.5);
      direction = glm::normalize(direction + 1.6 * out);
    }
    int from = static_cast<int>(i);
    const int steps = std::max(1, static_cast<int>(std::lround(length / s.hangingStep)));
    for (int k = 0; k < steps; ++k) {
      const std::uint64_t each = who << 8u | static_cast<std::uint64_t>(k);
      const dvec3 jitter(draw(seed, each, kJitter) - 0.5, draw(seed, each, kJitter + 1) - 0.5,
                         draw(seed, each, kJitter + 2) - 0.5);
      direction = glm::normalize(direction + dvec3(0, -0.35, 0) + 0.06 * jitter);
      const dvec3 place = grown.position[at(from)] + s.hangingStep * direction;
      if (place.y < kOverGround) break;
      const int node = grown.add(place, from, grown.birth[i], tip || k > 0);
      grown.source[at(node)] = (1 << 24) + static_cast<int>(who) * 64 + k;
      from = node;
    }
  }
}

void breakTwigs(Grown& grown, double breakage, quint64 seed) {
  if (!(breakage > 0)) return;
  const std::vector<double> reach = reachOf(grown);
  std::vector<char> keep(grown.size(), 1);
  for (std::size_t i = 1; i < grown.size(); ++i) {
    const auto who = static_cast<std::uint64_t>(grown.source[i]);
    const double whole = reach[i] + glm::length(grown.position[i] - grown.position[at(grown.parent[i])]);
    const bool worn = whole < 0.45 * (0.5 + draw(seed, who, kWear));
    const bool fell = grown.radius[i] > 0.012 && grown.radius[i] < 0.12 && draw(seed, who, kFalls) < breakage;
    keep[i] = !worn && !fell && keep[at(grown.parent[i])];
  }
  keepOnly(grown, keep);
}

}  // namespace windfall::model::growth
