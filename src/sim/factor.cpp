#include "sim/factor.h"

#include <algorithm>
#include <cmath>

#include "kernels/link_pose.h"
#include "kernels/wind_model.h"
#include "sim/factor_parts.h"

namespace windfall::sim {

namespace {

using glm::dmat3;
using glm::dvec3;

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

RestJoint::RestJoint(const LinkBody& body, const LinkBody* parent)
    : turn(parent != nullptr ? glm::normalize(glm::conjugate(parent->rotation) * body.rotation) : body.rotation),
      offset(parent != nullptr ? glm::transpose(parent->axes) * (body.joint - parent->joint) : body.joint) {}

void RestLoads::add(const LinkBody& body, const FactorSettings& settings) {
  const dvec3 own = body.mass * settings.gravity;
  const dvec3 all = own + settings.windDirection * meanDrag(body, settings);
  weight += own;
  torque += glm::cross(body.arm(), own);
  force += all;
  virial += glm::dot(body.arm(), all);
}

void RestLoads::add(const RestLoads& child, const dvec3& d) {
  weight += child.weight;
  torque += child.torque + glm::cross(d, child.weight);
  force += child.force;
  virial += child.virial + glm::dot(d, child.force);
}

void commonConstants(const LinkBody& body, const RestJoint& joint, const FactorSettings& settings,
                     const dvec3& preStress, std::span<double> constants) {
  constants[kHalf] = 0.5 * body.length;
  constants[kWeight] = body.mass * -settings.gravity.y;
  constants[kWoodDrag] = body.woodDrag;
  constants[kLeafDrag] = body.leafDrag;
  for (int k = 0; k < 3; ++k) {
    constants[kRestOffset + k] = joint.offset[k];
    constants[kPreStress + k] = preStress[k];
  }
  constants[kRestTurn] = joint.turn.x;
  constants[kRestTurn + 1] = joint.turn.y;
  constants[kRestTurn + 2] = joint.turn.z;
  constants[kRestTurn + 3] = joint.turn.w;
  constants[kBending] = body.stiffness.x;
  constants[kTwist] = body.stiffness.z;
}

std::unique_ptr<FactorPass> makeFactors(const Tree& tree, const FactorSettings& settings) {
  if (settings.method == TreeMethod::Coupled) return makeCoupledFactors(tree);
  if (settings.method == TreeMethod::Forces) return makeForcesFactors(tree);
  return makeModalFactors(tree, settings.calibrate && settings.method != TreeMethod::Literal);
}

void factorise(const FactorInput& input, ConstantSink& sink) {
  const std::unique_ptr<FactorPass> factors = makeFactors(*input.tree, input.settings);
  factors->begin(input);
  std::size_t visits = factors->visits();
  factors->advance(visits, sink);
}

}  // namespace windfall::sim
