#include "sim/factor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "kernels/link_coupled.h"
#include "kernels/wind_model.h"
#include "sim/bent_drag.h"

namespace windfall::sim {

namespace {

using glm::dmat3;
using glm::dvec3;

/// Matrix of the cross product v x.
dmat3 skew(const dvec3& v) { return {0, v.z, -v.y, -v.z, 0, v.x, v.y, -v.x, 0}; }

constexpr double kSlope = 1.5;  // kappa: dF/dv over C (2.4)
constexpr double kOverMean =
    1.15;  // level for the slope over the mean wind: the note takes 1.3 (6.2), V8 is met closer so
constexpr double kStillAir = 1.0;  // m/s, of branches in calm air
constexpr double kTwistFloor = 0.3;

/// C of F = C u at a speed across the branch, N s/m.
double dragAt(const LinkBody& body, double speed) {
  const double ratio = speed / static_cast<double>(kReconfigurationSpeed);
  return body.woodDrag * speed + body.leafDrag * speed / std::sqrt(1 + ratio * ratio);
}

double levelAt(const LinkBody& body, const FactorSettings& settings) {
  const double height = body.joint.y + body.arm().y;
  return std::max(kStillAir,
                  kOverMean * settings.windSpeed * static_cast<double>(windProfile(static_cast<float>(height))));
}

}  // namespace

RestLoads restLoads(const std::vector<LinkBody>& bodies, const FactorSettings& settings) {
  const std::size_t n = bodies.size();
  std::vector<dvec3> weight(n), torque(n), force(n);
  std::vector<double> virial(n);
  RestLoads loads{std::vector<dvec3>(n), std::vector<double>(n)};
  for (std::size_t i = n; i-- > 0;) {
    const LinkBody& body = bodies[i];
    const dvec3 own = body.mass * settings.gravity;
    const dvec3 all = own + settings.windDirection * meanDrag(body, settings);
    weight[i] += own;
    torque[i] += glm::cross(body.arm(), own);
    force[i] += all;
    virial[i] += glm::dot(body.arm(), all);
    loads.preStress[i] = glm::transpose(body.axes) * torque[i];
    loads.geometric[i] = std::max(0.0, virial[i]);
    if (body.parent < 0) continue;
    const auto p = static_cast<std::size_t>(body.parent);
    const dvec3 d = body.joint - bodies[p].joint;
    weight[p] += weight[i];
    torque[p] += torque[i] + glm::cross(d, weight[i]);
    force[p] += force[i];
    virial[p] += virial[i] + glm::dot(d, force[i]);
  }
  return loads;
}

double twistFloor(const LinkBody& body, const Composite& composite) {
  const dmat3 local = glm::transpose(body.axes) * composite.inertia * body.axes;
  return std::max(0.0, kTwistFloor * 0.5 * (local[0][0] + local[1][1]) - local[2][2]);
}

double meanDrag(const LinkBody& body, const FactorSettings& settings) {
  const double speed = settings.windSpeed > 0 ? levelAt(body, settings) : 0;
  return dragAt(body, speed) * speed;
}

double dragSlope(const LinkBody& body, const FactorSettings& settings) {
  return kSlope * dragAt(body, levelAt(body, settings));
}

void commonConstants(const std::vector<LinkBody>& bodies, std::size_t i, const FactorSettings& settings,
                     const dvec3& preStress, std::span<double> constants) {
  const LinkBody& body = bodies[i];
  const bool root = body.parent < 0;
  const LinkBody& parent = bodies[root ? i : static_cast<std::size_t>(body.parent)];
  const glm::dquat turn = root ? body.rotation : glm::normalize(glm::conjugate(parent.rotation) * body.rotation);
  const dvec3 offset = root ? body.joint : glm::transpose(parent.axes) * (body.joint - parent.joint);
  constants[kHalf] = 0.5 * body.length;
  constants[kWeight] = body.mass * -settings.gravity.y;
  constants[kWoodDrag] = body.woodDrag;
  constants[kLeafDrag] = body.leafDrag;
  for (int k = 0; k < 3; ++k) {
    constants[kRestOffset + k] = offset[k];
    constants[kPreStress + k] = preStress[k];
  }
  constants[kRestTurn] = turn.x;
  constants[kRestTurn + 1] = turn.y;
  constants[kRestTurn + 2] = turn.z;
  constants[kRestTurn + 3] = turn.w;
  constants[kBending] = body.stiffness.x;
  constants[kTwist] = body.stiffness.z;
}

void factorise(const std::vector<LinkBody>& bodies, double frequency, const FactorSettings& settings,
               const ConstantSink& sink, std::span<LinkInertia> inertias) {
  switch (settings.method) {
    case TreeMethod::Coupled:
      factoriseCoupled(bodies, frequency, settings, sink, inertias);
      break;
    case TreeMethod::Analytic:
    case TreeMethod::Literal:
      factoriseModal(bodies, settings, sink);
      break;
    case TreeMethod::Forces:
      factoriseForces(bodies, settings, sink);
      break;
  }
}

void factoriseCoupled(const std::vector<LinkBody>& bodies, double frequency, const FactorSettings& settings,
                      const ConstantSink& sink, std::span<LinkInertia> inertias) {
  const std::vector<Composite> composites = compositesOf(bodies);
  const RestLoads loads = restLoads(bodies, settings);
  const std::size_t n = bodies.size();
  const std::vector<double> bent = settings.bentDrag ? bentTwistDrag(bodies, settings) : std::vector<double>(n);
  std::array<double, kCoupledConstants> constants{};
  const double beta = frequency > 0 ? 2 * settings.dampingRatio / (2 * std::numbers::pi * frequency) : 0;
  const double vh = settings.implicitness * settings.h;
  const double numerical = settings.compensate ? (2 * settings.implicitness - 1) * settings.h : 0;

  // Articulated inertia of each link in its own rest frame: [J H; H^T M].
  std::vector<dmat3> inertia(n, dmat3(0)), coupling(n, dmat3(0)), mass(n, dmat3(0));
  for (std::size_t i = n; i-- > 0;) {
    const LinkBody& body = bodies[i];
    // Damping by mass acts as a drag of the whole link.
    const double slope = dragSlope(body, settings) + body.rayleighAlpha * body.mass;
    const double heavy = body.mass + vh * slope;
    const dmat3 arm = skew(dvec3(0, 0, 0.5 * body.length));
    dmat3& j = inertia[i];
    dmat3& h = coupling[i];
    dmat3& m = mass[i];
    j += dmat3(body.across, 0, 0, 0, body.across, 0, 0, 0, body.along) + heavy * glm::transpose(arm) * arm;
    h += heavy * arm;
    m += dmat3(heavy);

    const double ownBeta = std::max(0.0, beta * body.dampingScale + body.rayleighBeta - numerical);
    const double geometric = loads.geometric[i];
    dvec3 diagonal = body.stiffness * (vh * ownBeta + vh * vh) + dvec3(geometric * vh * vh);
    const double floor = settings.twistFloor ? twistFloor(body, composites[i]) : 0;
    diagonal.z += floor;
    diagonal.z += vh * bent[i];
    const auto narrow = [](double value) { return static_cast<float>(value); };
    inertias[i] = {narrow(body.mass), narrow(body.across), narrow(body.along), narrow(floor)};
    const dmat3 inverse = glm::inverse(j + dmat3(diagonal.x, 0, 0, 0, diagonal.y, 0, 0, 0, diagonal.z));
    const dmat3 jd = j * inverse, hd = glm::transpose(h) * inverse;

    const bool root = body.parent < 0;
    const LinkBody& parent = bodies[root ? i : static_cast<std::size_t>(body.parent)];
    const glm::dquat turn = root ? body.rotation : glm::normalize(glm::conjugate(parent.rotation) * body.rotation);
    const dvec3 offset = root ? body.joint : glm::transpose(parent.axes) * (body.joint - parent.joint);
    const dmat3 r = glm::mat3_cast(turn), s = skew(offset);
    const dmat3 bottom = r * hd, top = r * jd + s * bottom;
    if (!root) {
      const auto p = static_cast<std::size_t>(body.parent);
      const auto turned = [&](const dmat3& x) { return r * x * glm::transpose(r); };
      const dmat3 ja = turned(j - jd * j), ha = turned(h - jd * h), ma = turned(m - hd * h);
      const dmat3 sha = s * glm::transpose(ha);
      inertia[p] += ja + sha + glm::transpose(sha) - s * ma * s;
      coupling[p] += ha + s * ma;
      mass[p] += ma;
    }

    commonConstants(bodies, i, settings, loads.preStress[i], constants);
    constants[kDragSlope] = slope;
    constants[kBendingSpeed] = body.stiffness.x * (vh + ownBeta) + geometric * vh;
    constants[kTwistSpeed] = body.stiffness.z * (vh + ownBeta) + geometric * vh + bent[i];
    std::size_t k = kInverse;
    for (int row = 0; row < 3; ++row) {
      for (int column = row; column < 3; ++column) constants[k++] = 0.5 * (inverse[column][row] + inverse[row][column]);
    }
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) {
        constants[kTransfer + static_cast<std::size_t>(row * 3 + column)] = top[column][row];
        constants[kTransfer + 9 + static_cast<std::size_t>(row * 3 + column)] = bottom[column][row];
      }
    }
    sink(i, constants);
  }
}

}  // namespace windfall::sim
