// A tree's links as bodies with mass, inertia, stiffness and drag (tree_dynamics.md, 2), in double precision.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "sim/engine.h"
#include "sim/tree.h"

namespace windfall::sim {

/// A link placed in the world at rest. SI units.
struct LinkBody {
  int parent = -1;
  bool continues = false;           ///< the parent belongs to the same axis
  glm::dvec3 joint{0};              ///< world
  glm::dmat3 axes{1};               ///< link frame to world
  glm::dquat rotation{1, 0, 0, 0};  ///< the same
  double length = 0, radius = 0;
  double mass = 0;
  double across = 0, along = 0;  ///< inertia about the centre of mass, kg m2
  glm::dvec3 stiffness{1};       ///< N m/rad: bending, bending, twist
  double dampingScale = 1;
  double rayleighAlpha = 0, rayleighBeta = 0;  ///< 1/s and s, beside the structural damping
  double propagation = 0.8;                    ///< of the forces method: k_c of its section 7
  double woodDrag = 0, leafDrag = 0;           ///< see LinkShape
  /// Centre of mass from the joint, world.
  glm::dvec3 arm() const { return axes[2] * (0.5 * length); }
};

/// Where a tree stands, as bodies take it.
struct Ground {
  glm::dvec3 position{0};
  glm::dquat turn{1, 0, 0, 0};
  Ground() = default;
  explicit Ground(const Placement& placement);
};

/// The body of one link that has lost `lostArea` m2 of its leaves.
LinkBody bodyOf(const Tree& tree, std::size_t link, const Ground& ground, double lostArea);

/// Bodies of all links; `lostArea` (m2 a link; empty: nothing) is the area of the leaves that have fallen.
std::vector<LinkBody> bodiesOf(const Tree& tree, const Placement& placement = {}, std::span<const float> lostArea = {});

/// Mass and inertia of everything outboard of a joint as one rigid body (5.1).
struct Composite {
  double mass = 0;
  glm::dvec3 moment{0};   ///< sum of m r about the joint, world
  glm::dmat3 inertia{0};  ///< about the joint, world

  /// Adds the joint's own link.
  void add(const LinkBody& body);
  /// Adds what a child carries whose joint stands `d` from this one.
  void add(const Composite& child, const glm::dvec3& d);
};
std::vector<Composite> compositesOf(const std::vector<LinkBody>& bodies);

/// First frequency of a tree of given bodies, Hz (2.7).
double firstFrequency(const std::vector<LinkBody>& bodies);

/// Why the tree can't be simulated, in one line; empty when it can.
std::string problemOf(const Tree& tree);

}  // namespace windfall::sim
