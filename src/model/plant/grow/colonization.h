// Space colonization (Runions, Lane, Prusinkiewicz 2007; growers.md, 1).
#pragma once

#include "model/plant/grow/grown.h"
#include "model/plant/grow/settings.h"
#include "model/progress.h"
#include "sim/result.h"

namespace windfall::model::growth {

/// What the artist changes while the plant grows: from round `when` on growth goes on from it.
struct GrowthEvent {
  double when = 0;          ///< round, or year
  int node = -1;            ///< that it concerns, the grower's number, if that still stands near `place`
  dvec3 place{0};           ///< m, in the grower's space
  bool prune = false;       ///< the node and what it carries go; the space is free again
  std::vector<dvec3> line;  ///< else: new nodes that hang on it, one after the other
};

/// The node that an event means: its number where that lies within `near` m of its place, else the nearest within
/// twice that; -1: none. `gone[i]` leaves node i out.
template <class PositionOf>
int findEventNode(const GrowthEvent& event, std::size_t count, double near, const PositionOf& positionOf) {
  if (event.node >= 0 && at(event.node) < count) {
    const dvec3* place = positionOf(at(event.node));
    if (place && glm::length(*place - event.place) < near) return event.node;
  }
  int best = -1;
  double least = 2 * near;
  for (std::size_t i = 0; i < count; ++i) {
    const dvec3* place = positionOf(i);
    if (!place) continue;
    const double distance = glm::length(*place - event.place);
    if (distance < least) least = distance, best = static_cast<int>(i);
  }
  return best;
}

struct Colonized {
  Grown grown;  ///< raw: axes and radii are not set; `birth` counts rounds
  int rounds = 0;
  int unreachable = 0;  ///< points that were given up
  int left = 0;         ///< points that nothing came near
};

/// Grows a skeleton into points. `chain`: the seeded trunk, root first. `events` in order of time.
Colonized colonize(const ColonizationSettings& settings, std::vector<dvec3> points, const Grown& chain, quint64 seed,
                   const std::vector<GrowthEvent>& events, Progress& progress);

/// Trunks from the root to settings.trunkTop, lengthened until points are in reach (1.2).
Result<Grown> seedTrunks(const ColonizationSettings& settings, double height, const std::vector<dvec3>& points,
                         quint64 seed);

}  // namespace windfall::model::growth
