// The joints of the forces method, repaired (tree_dynamics.md, 7).
#include <algorithm>
#include <array>
#include <cmath>

#include "kernels/link_forces.h"
#include "sim/factor.h"

namespace windfall::sim {

void factoriseForces(const std::vector<LinkBody>& bodies, const FactorSettings& settings, const ConstantSink& sink) {
  std::array<double, kForcesConstants> constants{};
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const LinkBody& body = bodies[i];
    // Weight and the torque that carries it are in balance at rest; this method knows neither.
    commonConstants(bodies, i, settings, glm::dvec3(0), constants);
    const double across = body.across + 0.25 * body.mass * body.length * body.length;
    const double along = std::max(body.along, 0.3 * across);
    const auto structural = [&](double k, double inertia) {
      return body.dampingScale * 2 * settings.dampingRatio * std::sqrt(k * inertia) + body.rayleighBeta * k +
             body.rayleighAlpha * inertia;
    };
    const double air = dragSlope(body, settings) * body.length * body.length / 3;
    constants[kInertia] = across;
    constants[kTwistInertia] = along;
    constants[kLinearDamping] = structural(body.stiffness.x, across) + air;
    constants[kForcesTwistDamping] = structural(body.stiffness.z, along);
    // A cylinder that sweeps about its end: the drag's torque is 0.5 rho d l^4 / 4 w |w|.
    constants[kQuadraticDamping] = 0.25 * body.woodDrag * std::pow(body.length, 3);
    const double parent = body.parent < 0 ? body.radius : bodies[static_cast<std::size_t>(body.parent)].radius;
    constants[kPropagation] = std::clamp(body.propagation * body.radius / parent, 0.0, 0.8);
    sink(i, constants);
  }
}

}  // namespace windfall::sim
