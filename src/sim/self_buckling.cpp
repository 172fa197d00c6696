#include "sim/self_buckling.h"

#include <cmath>

#include "sim/bodies.h"

namespace windfall::sim {

namespace {

using glm::dvec3;
const dvec3 kGravity(0, -9.81, 0);
constexpr int kIterations = 120;

/// G x for joint angles x in joint frames: exact, by one downward and one upward pass.
class GravityTorque {
 public:
  explicit GravityTorque(const std::vector<LinkBody>& bodies)
      : bodies_(bodies),
        turn_(bodies.size()),
        joint_(bodies.size()),
        moved_(bodies.size()),
        mass_(bodies.size()),
        rest_(bodies.size()) {
    // Torque of the weight about each joint at rest.
    std::vector<dvec3> moment(bodies.size());
    for (std::size_t i = bodies.size(); i-- > 0;) {
      mass_[i] += bodies[i].mass;
      moment[i] += bodies[i].mass * bodies[i].arm();
      rest_[i] = glm::cross(moment[i], kGravity);
      if (bodies[i].parent < 0) continue;
      const auto p = static_cast<std::size_t>(bodies[i].parent);
      mass_[p] += mass_[i];
      moment[p] += moment[i] + mass_[i] * (bodies[i].joint - bodies[p].joint);
    }
  }

  void apply(const std::vector<dvec3>& x, std::vector<dvec3>& result) {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const LinkBody& body = bodies_[i];
      dvec3 above(0), carried(0);
      if (body.parent >= 0) {
        const auto p = static_cast<std::size_t>(body.parent);
        above = turn_[p];
        carried = joint_[p] + glm::cross(above, body.joint - bodies_[p].joint);
      }
      turn_[i] = above + body.axes * x[i];
      joint_[i] = carried;
      moved_[i] = body.mass * (carried + glm::cross(turn_[i], body.arm()));
    }
    for (std::size_t i = bodies_.size(); i-- > 0;) {
      const LinkBody& body = bodies_[i];
      dvec3 torque = glm::cross(moved_[i] - mass_[i] * joint_[i], kGravity);
      if (body.parent >= 0) {
        const auto p = static_cast<std::size_t>(body.parent);
        moved_[p] += moved_[i];
        // The joint's frame turns with the parent, the weight does not.
        torque -= glm::cross(turn_[p], rest_[i]);
      }
      result[i] = glm::transpose(body.axes) * torque;
    }
  }

 private:
  const std::vector<LinkBody>& bodies_;
  std::vector<dvec3> turn_, joint_, moved_;
  std::vector<double> mass_;
  std::vector<dvec3> rest_;
};

}  // namespace

double selfBuckling(const Tree& tree) {
  const std::vector<LinkBody> bodies = bodiesOf(tree);
  if (bodies.empty()) return 0;
  GravityTorque gravity(bodies);
  std::vector<dvec3> x(bodies.size()), y(bodies.size());
  // Power iteration finds the eigenvalue of largest size; where that one belongs to what hangs, a shift by it brings
  // the largest positive one to the front.
  const auto iterate = [&](double shift) {
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = dvec3(1, 0.6, 0.05);
    double value = 0;
    for (int k = 0; k < kIterations; ++k) {
      gravity.apply(x, y);
      double product = 0, elastic = 0;
      for (std::size_t i = 0; i < x.size(); ++i) {
        product += glm::dot(x[i], y[i]);
        elastic += glm::dot(x[i], bodies[i].stiffness * x[i]);
      }
      if (!(elastic > 0) || !std::isfinite(product)) return 0.0;
      value = product / elastic;
      double norm = 0;
      for (std::size_t i = 0; i < x.size(); ++i) {
        x[i] = y[i] / bodies[i].stiffness + shift * x[i];
        norm += glm::dot(x[i], x[i]);
      }
      if (!(norm > 0)) return value;
      const double scale = 1 / std::sqrt(norm);
      for (dvec3& v : x) v *= scale;
    }
    return value;
  };
  const double first = iterate(0);
  return first >= 0 ? first : std::max(0.0, iterate(-first));
}

}  // namespace windfall::sim
