#include "sim/bent_drag.h"

#include <algorithm>
#include <cmath>

namespace windfall::sim {

namespace {

using glm::dmat3;
using glm::dvec3;

constexpr int kRounds = 4;             // towards the balance of springs and wind
constexpr double kLargestAngle = 0.8;  // rad of a joint, as in the solvers' saturation (5.5)

dmat3 turnBy(const dvec3& angle) {
  const double size = glm::length(angle);
  return size > 1e-12 ? glm::mat3_cast(glm::angleAxis(size, angle / size)) : dmat3(1);
}

/// A tree that leans in the wind.
class Leaning {
 public:
  Leaning(const std::vector<LinkBody>& bodies, const FactorSettings& settings)
      : bodies_(bodies), bent_(bodies), frames_(bodies.size()), angles_(bodies.size()) {
    for (const LinkBody& body : bodies) wind_.push_back(settings.windDirection * meanDrag(body, settings));
    for (int round = 0; round < kRounds; ++round) {
      balance();
      pose();
    }
  }

  /// Damping of a joint's twist by drags instead of masses in the bodies as they lean.
  double twistOf(const Composite& drag, std::size_t i) const {
    const dvec3 along = frames_[i][2];
    return glm::dot(along, drag.inertia * along);
  }
  std::vector<LinkBody>& bodies() { return bent_; }

 private:
  /// Angles halfway to those that carry the wind in the current pose.
  void balance() {
    std::vector<dvec3> force(wind_), torque(bodies_.size());
    for (std::size_t i = bodies_.size(); i-- > 0;) {
      torque[i] += glm::cross(bent_[i].arm(), wind_[i]);
      const dmat3& frame = frames_[i] == dmat3(0) ? bodies_[i].axes : frames_[i];
      const dvec3 wanted = glm::transpose(frame) * torque[i] / bodies_[i].stiffness;
      const double size = glm::length(wanted) / kLargestAngle;
      angles_[i] = 0.5 * (angles_[i] + wanted / std::sqrt(std::sqrt(1 + size * size * size * size)));
      if (bodies_[i].parent < 0) continue;
      const auto p = static_cast<std::size_t>(bodies_[i].parent);
      force[p] += force[i];
      torque[p] += torque[i] + glm::cross(bent_[i].joint - bent_[p].joint, force[i]);
    }
  }

  void pose() {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      frames_[i] = bodies_[i].axes;
      if (bodies_[i].parent >= 0) {
        const auto p = static_cast<std::size_t>(bodies_[i].parent);
        const dmat3 turn = bent_[p].axes * glm::transpose(bodies_[p].axes);
        frames_[i] = turn * bodies_[i].axes;
        bent_[i].joint = bent_[p].joint + turn * (bodies_[i].joint - bodies_[p].joint);
      }
      bent_[i].axes = frames_[i] * turnBy(angles_[i]);
    }
  }

  const std::vector<LinkBody>& bodies_;
  std::vector<LinkBody> bent_;
  std::vector<dmat3> frames_;  ///< of the joints
  std::vector<dvec3> angles_, wind_;
};

}  // namespace

std::vector<double> bentTwistDrag(const std::vector<LinkBody>& bodies, const FactorSettings& settings) {
  std::vector<double> more(bodies.size());
  if (!(settings.windSpeed > 0)) return more;
  Leaning leaning(bodies, settings);
  std::vector<LinkBody> straight = bodies;
  for (std::vector<LinkBody>* all : {&straight, &leaning.bodies()}) {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      (*all)[i].mass = dragSlope(bodies[i], settings);
      (*all)[i].across = (*all)[i].along = 0;
    }
  }
  const std::vector<Composite> atRest = compositesOf(straight), bent = compositesOf(leaning.bodies());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const dvec3 along = bodies[i].axes[2];
    more[i] = std::max(0.0, leaning.twistOf(bent[i], i) - glm::dot(along, atRest[i].inertia * along));
  }
  return more;
}

}  // namespace windfall::sim
