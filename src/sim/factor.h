// What the solvers keep of a tree at rest, in double precision: common constants, the factorisation of the coupled
// system (tree_dynamics.md, 6.2), the modes of the analytic joints (5), the forces method's joints (7).
#pragma once

#include <memory>
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
  double dampingRatio = 0.03;       ///< structural: of the first mode; of each joint (literal, forces)
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

/// Force of the mean wind on a link, N.
double meanDrag(const LinkBody& body, const FactorSettings& settings);

/// dF/dv of a link's drag at the level of the mean wind, N s/m (2.4, 5.8).
double dragSlope(const LinkBody& body, const FactorSettings& settings);

/// What constants are made of. The tree stays as it is until they are made.
struct FactorInput {
  const Tree* tree = nullptr;
  Ground ground;
  std::span<const float> lostArea;  ///< of each link's fallen leaves, m2; empty: none
  double frequency = 0;             ///< the tree's first, Hz, which structural damping refers to
  FactorSettings settings;

  LinkBody body(std::size_t link) const {
    return bodyOf(*tree, link, ground, lostArea.empty() ? 0 : static_cast<double>(lostArea[link]));
  }
};

/// Takes constants of a link, in the order of the solver's fields, from field `first` on; `inertia` with the last ones.
class ConstantSink {
 public:
  virtual void put(std::size_t link, std::uint32_t first, std::span<const double> constants) = 0;
  virtual void put(std::size_t link, const LinkInertia& inertia) = 0;

 protected:
  ~ConstantSink() = default;
};

/// One way through a tree that makes something of it, a piece at a time. Memory is taken when it is made.
class FactorPass {
 public:
  virtual ~FactorPass() = default;
  /// Starts anew; the input stays until the pass is done.
  virtual void begin(const FactorInput& input) = 0;
  /// Goes on for at most `visits` visits, which it takes off. True when all is done.
  virtual bool advance(std::size_t& visits, ConstantSink& sink) = 0;
  /// Visits in all.
  virtual std::size_t visits() const = 0;
  /// Bytes that it keeps.
  virtual std::size_t bytes() const = 0;
};

/// Makes the constants of all links of a tree for the solver of the settings' method, which was chosen for good.
std::unique_ptr<FactorPass> makeFactors(const Tree& tree, const FactorSettings& settings);

/// All at once.
void factorise(const FactorInput& input, ConstantSink& sink);

}  // namespace windfall::sim
