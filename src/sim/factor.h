// The load-time factorisation of the coupled system (tree_dynamics.md, 6.2), in double precision.
#pragma once

#include <span>
#include <vector>

#include "kernels/link_data.h"
#include "sim/bodies.h"

namespace windfall::sim {

/// How a tree is stepped. The defaults are the ones that ship; tests vary them.
struct FactorSettings {
  double h = 1.0 / 60;              ///< s
  double implicitness = 0.6;        ///< theta of 6.1
  double dampingRatio = 0.03;       ///< structural, of the first mode
  bool compensate = true;           ///< numerical damping is taken off the structural one
  glm::dvec3 gravity{0, -9.81, 0};  ///< m/s2
  double windSpeed = 0;             ///< mean at 10 m, m/s, for the drag's slope
  glm::dvec3 windDirection{1, 0, 0};
  bool twistFloor = true;  ///< 5.6
};

/// Twist inertia that a joint gets on top, kg m2, so that straight twigs do not flutter (5.6). It acts on the joint's
/// own turning only, as a rotor's would.
double twistFloor(const LinkBody& body, const Composite& composite);

/// Mass and inertia of a link for the energies.
struct LinkInertia {
  float mass = 0, across = 0, along = 0, floor = 0;
};

/// Fills shapes, factors and inertia of one tree's links; `first` is the global index of its first link, `frequency`
/// its first frequency in Hz, which the structural damping refers to.
void factorise(const std::vector<LinkBody>& bodies, double frequency, const FactorSettings& settings,
               std::int32_t first, std::span<LinkShape> shapes, std::span<LinkFactor> factors,
               std::span<LinkInertia> inertias);

}  // namespace windfall::sim
