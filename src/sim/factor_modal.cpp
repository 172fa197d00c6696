// The modes of the analytic solver's joints (tree_dynamics.md, 5.2, 5.6 to 5.8).
#include <algorithm>
#include <array>
#include <cmath>

#include "kernels/link_modal.h"
#include "sim/axis_modes.h"
#include "sim/bent_drag.h"
#include "sim/factor.h"
#include "sim/symmetric_eigen.h"

namespace windfall::sim {

namespace {

using glm::dmat3;
using glm::dvec3;

/// The drag's slope in the place of mass.
std::vector<LinkBody> dragBodies(const std::vector<LinkBody>& bodies, const FactorSettings& settings) {
  std::vector<LinkBody> drags = bodies;
  for (std::size_t i = 0; i < drags.size(); ++i) {
    drags[i].mass = dragSlope(bodies[i], settings);
    drags[i].across = drags[i].along = 0;
  }
  return drags;
}

}  // namespace

void factoriseModal(const std::vector<LinkBody>& bodies, const FactorSettings& settings, const ConstantSink& sink) {
  const std::vector<Composite> composites = compositesOf(bodies);
  const std::vector<Composite> drags = compositesOf(dragBodies(bodies, settings));
  const bool calibrated = settings.calibrate && settings.method != TreeMethod::Literal;
  const std::vector<AxisMode> modes =
      calibrated ? axisModes(bodies, composites, drags) : std::vector<AxisMode>(bodies.size());
  const RestLoads loads = restLoads(bodies, settings);
  const std::vector<double> bent =
      calibrated && settings.bentDrag ? bentTwistDrag(bodies, settings) : std::vector<double>(bodies.size());
  std::array<double, kAxisConstants> constants{};
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const LinkBody& body = bodies[i];
    dmat3 inertia = glm::transpose(body.axes) * composites[i].inertia * body.axes;
    if (settings.twistFloor) inertia[2][2] += twistFloor(body, composites[i]);
    // By itself every joint would swing too fast, the more so the finer the axis is cut; as part of the axis' mode it
    // has the inertia k / Omega^2.
    double air = 0;
    if (calibrated && modes[i].square > 0) {
      const double bending = inertia[0][0] * inertia[1][1] - inertia[1][0] * inertia[0][1];
      inertia *= body.stiffness.x / (modes[i].square * std::sqrt(std::max(bending, 1e-300)));
      air = modes[i].airRate;
    } else {
      const dmat3 &drag = drags[i].inertia, &mass = composites[i].inertia;
      air = (drag[0][0] + drag[1][1] + drag[2][2]) / (mass[0][0] + mass[1][1] + mass[2][2]);
    }
    const dvec3 s = 1.0 / glm::sqrt(body.stiffness);
    dmat3 scaled = inertia;
    for (int column = 0; column < 3; ++column) {
      for (int row = 0; row < 3; ++row) scaled[column][row] *= s[column] * s[row];
    }
    dvec3 mu;
    dmat3 vectors;
    symmetricEigen(scaled, mu, vectors);
    commonConstants(bodies, i, settings, loads.preStress[i], constants);
    for (int a = 0; a < 3; ++a) {
      const double lambda = 1 / std::max(mu[a], 1e-30);
      for (int row = 0; row < 3; ++row) constants[kModes + 3 * a + row] = s[row] * vectors[a][row];
      constants[kSquares + a] = lambda;
      // Of a mode u the damping is u D u over u I u = 1 / lambda.
      const double twist = s.z * vectors[a][2], sweep = bent[i] * twist * twist * lambda;
      constants[kDampings + a] = body.dampingScale * settings.dampingRatio * std::sqrt(lambda) +
                                 0.5 * (air + sweep + body.rayleighAlpha + body.rayleighBeta * lambda);
    }
    const auto put = [&](std::size_t moment, std::size_t matrix, const Composite& c) {
      const dvec3 m = glm::transpose(body.axes) * c.moment;
      const dmat3 local = glm::transpose(body.axes) * c.inertia * body.axes;
      std::size_t k = matrix;
      for (int row = 0; row < 3; ++row) {
        constants[moment + static_cast<std::size_t>(row)] = m[row];
        for (int column = row; column < 3; ++column) constants[k++] = local[column][row];
      }
    };
    put(kMoment, kInertia6, composites[i]);
    put(kDragMoment, kDragInertia, drags[i]);
    sink(i, constants);
  }
}

}  // namespace windfall::sim
