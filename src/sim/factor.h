// What the solvers keep of a tree at rest, in double precision: common constants, the factorisation of the coupled
// system (tree_dynamics.md, 6.2), the modes of the analytic joints (5), the forces method's joints (7).
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "sim/bodies.h"
#include "sim/settings.h"

namespace windfall::sim {

/// How a tree is stepped. The defaults are the ones that ship; tests vary them.
struct FactorSettings {
  TreeMethod method = TreeMethod::Coupled;
  double h = 1.0 / 60;              ///< s
  double implicitness = 0.6;        ///< theta of 6.1
  double dampingRatio = 0.03;       ///< structural: of the first mode (coupled), of each joint (analytic)
  double frequency = 0;             ///< above 0: taken for every tree's first in the place of its own, Hz
  bool compensate = true;           ///< numerical damping is taken off the structural one
  glm::dvec3 gravity{0, -9.81, 0};  ///< m/s2
  double windSpeed = 0;             ///< mean at 10 m, m/s, for the drag's slope
  glm::dvec3 windDirection{1, 0, 0};
  bool axisMotion = false;  ///< analytic: fictitious torques of a moving base (5.9)
  bool twistFloor = true;   ///< 5.6
  bool bentDrag =
      true;  ///< what the mean wind has bent is braked in its twist (bent_drag.h); not in the literal method
  bool calibrate = true;  ///< 5.7; off for the literal method
};

/// Twist inertia that a joint gets on top, kg m2, so that straight twigs do not flutter (5.6). It acts on the joint's
/// own turning only, as a rotor's would.
double twistFloor(const LinkBody& body, const Composite& composite);

/// Mass and inertia of a link for the energies.
struct LinkInertia {
  float mass = 0, across = 0, along = 0, floor = 0;
};

/// Torque that gravity exerts at rest, joint frame; and how strongly wind and weight pull each subtree outward (5.4), N
/// m/rad.
struct RestLoads {
  std::vector<glm::dvec3> preStress;
  std::vector<double> geometric;
};
RestLoads restLoads(const std::vector<LinkBody>& bodies, const FactorSettings& settings);

/// Force of the mean wind on a link, N.
double meanDrag(const LinkBody& body, const FactorSettings& settings);

/// dF/dv of a link's drag at the level of the mean wind, N s/m (2.4, 5.8).
double dragSlope(const LinkBody& body, const FactorSettings& settings);

/// Fills the first kCommonConstants of a link's constants.
void commonConstants(const std::vector<LinkBody>& bodies, std::size_t i, const FactorSettings& settings,
                     const glm::dvec3& preStress, std::span<double> constants);

/// Takes the constants of one link, in the order of the solver's fields.
using ConstantSink = std::function<void(std::size_t link, std::span<const double> constants)>;

/// Constants of all links of a tree for the solver of settings.method. `frequency`: the tree's first in Hz, which the
/// structural damping of the coupled solver refers to.
void factorise(const std::vector<LinkBody>& bodies, double frequency, const FactorSettings& settings,
               const ConstantSink& sink, std::span<LinkInertia> inertias);

void factoriseCoupled(const std::vector<LinkBody>& bodies, double frequency, const FactorSettings& settings,
                      const ConstantSink& sink, std::span<LinkInertia> inertias);
void factoriseModal(const std::vector<LinkBody>& bodies, const FactorSettings& settings, const ConstantSink& sink);
void factoriseForces(const std::vector<LinkBody>& bodies, const FactorSettings& settings, const ConstantSink& sink);

}  // namespace windfall::sim
