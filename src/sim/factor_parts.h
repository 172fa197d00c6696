// What the makers of constants share. Only for factor*.cpp.
#pragma once

#include <span>

#include "kernels/link_slots.h"
#include "sim/branch_walk.h"
#include "sim/factor.h"

namespace windfall::sim {

/// Where a link stands on its parent at rest; a root: in the world.
struct RestJoint {
  glm::dquat turn{1, 0, 0, 0};
  glm::dvec3 offset{0};
  RestJoint(const LinkBody& body, const LinkBody* parent);
};

/// Torque that gravity exerts at rest, and how strongly wind and weight pull a subtree outward (5.4).
struct RestLoads {
  glm::dvec3 weight{0}, torque{0}, force{0};  ///< world; the torque about the joint
  double virial = 0;

  /// Adds the joint's own link.
  void add(const LinkBody& body, const FactorSettings& settings);
  /// Adds what a child carries whose joint stands `d` from this one.
  void add(const RestLoads& child, const glm::dvec3& d);
  double geometric() const { return virial > 0 ? virial : 0; }  ///< N m/rad
};

/// Fills the first kCommonConstants of a link's constants; `preStress` is in the joint's frame.
void commonConstants(const LinkBody& body, const RestJoint& joint, const FactorSettings& settings,
                     const glm::dvec3& preStress, std::span<double> constants);

std::unique_ptr<FactorPass> makeCoupledFactors(const Tree& tree);
std::unique_ptr<FactorPass> makeModalFactors(const Tree& tree, bool calibrated);
std::unique_ptr<FactorPass> makeForcesFactors(const Tree& tree);

}  // namespace windfall::sim
