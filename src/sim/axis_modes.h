// The first cantilever mode of every axis of a tree by itself: what the analytic solver's joints are calibrated to
// (tree_dynamics.md, 5.7).
#pragma once

#include <span>
#include <vector>

#include "sim/bodies.h"

namespace windfall::sim {

/// An axis swaying by itself, its side axes rigid and its base held.
struct AxisMode {
  double square = 0;   ///< squared angular frequency, 1/s2
  double airRate = 0;  ///< damping by the air over mass, sum c v2 / sum m v2, 1/s (5.8)
};

/// One axis: its links from base to tip, each with all that it carries.
struct AxisLinks {
  std::span<const LinkBody> bodies;
  std::span<const Composite> composites;
  std::span<const Composite> drags;  ///< composites of the drag's slope in the place of mass
};

/// Finds modes; memory is taken when it is made.
class AxisModes {
 public:
  /// `longest`: links of an axis, at most.
  explicit AxisModes(std::size_t longest);
  AxisMode modeOf(const AxisLinks& links);

 private:
  using Vectors = std::vector<glm::dvec3>;
  /// Leaves to each link what it carries itself: rigid side axes are part of it.
  static void toLumps(std::span<const LinkBody> bodies, std::span<const Composite> composites,
                      std::vector<Composite>& lumps);
  void load(const std::vector<Composite>& lumps, const glm::dvec3& direction);
  void massTimes(const std::vector<Composite>& lumps, const Vectors& angle, Vectors& torque);
  void sum(Vectors& torque);
  glm::dvec3 step(std::size_t k) const { return bodies_[k].joint - bodies_[k - 1].joint; }

  std::span<const LinkBody> bodies_;
  std::vector<Composite> mass_, drag_;
  Vectors force_, angle_, torque_, draft_;
};

}  // namespace windfall::sim
