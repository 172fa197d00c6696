#include "sim/bent_drag.h"

#include <algorithm>
#include <cmath>

namespace windfall::sim {

namespace {

using glm::dmat3;
using glm::dvec3;

constexpr double kGust = 2;            // of the mean wind: it is gusts that twist
constexpr int kRounds = 3;             // towards the balance of springs and wind
constexpr double kLargestAngle = 0.8;  // rad of a joint, as in the solvers' saturation (5.5)

dmat3 turnBy(const dvec3& angle) {
  const double size = glm::length(angle);
  return size > 1e-12 ? glm::mat3_cast(glm::angleAxis(size, angle / size)) : dmat3(1);
}

/// A tree that leans in the wind, with the slopes of its drag in the place of masses.
class Leaning {
 public:
  Leaning(const std::vector<LinkBody>& bodies, const FactorSettings& settings)
      : bodies_(bodies), bent_(bodies), frames_(bodies.size()), angles_(bodies.size()), wind_(bodies.size()) {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      wind_[i] = settings.windDirection * meanDrag(bodies[i], settings);
      frames_[i] = bodies[i].axes;
      bent_[i].mass = dragSlope(bodies[i], settings);
      bent_[i].across = bent_[i].along = 0;
    }
  }

  /// Turns the joints towards the angles that carry the wind in the current pose.
  void lean() {
    force_ = wind_;
    torque_.assign(bodies_.size(), dvec3(0));
    for (std::size_t i = bodies_.size(); i-- > 0;) {
      torque_[i] += glm::cross(bent_[i].arm(), wind_[i]);
      const dvec3 wanted = glm::transpose(frames_[i]) * torque_[i] / bodies_[i].stiffness;
      const double size = glm::length(wanted) / kLargestAngle;
      angles_[i] = 0.5 * (angles_[i] + wanted / std::sqrt(std::sqrt(1 + size * size * size * size)));
      if (bodies_[i].parent < 0) continue;
      const auto p = static_cast<std::size_t>(bodies_[i].parent);
      force_[p] += force_[i];
      torque_[p] += torque_[i] + glm::cross(bent_[i].joint - bent_[p].joint, force_[i]);
    }
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      if (bodies_[i].parent >= 0) {
        const auto p = static_cast<std::size_t>(bodies_[i].parent);
        const dmat3 turn = bent_[p].axes * glm::transpose(bodies_[p].axes);
        frames_[i] = turn * bodies_[i].axes;
        bent_[i].joint = bent_[p].joint + turn * (bodies_[i].joint - bodies_[p].joint);
      }
      bent_[i].axes = frames_[i] * turnBy(angles_[i]);
    }
  }

  /// Drag that each joint's twist meets, N m s.
  std::vector<double> twistDrag() const {
    const std::vector<Composite> drags = compositesOf(bent_);
    std::vector<double> twist(drags.size());
    for (std::size_t i = 0; i < twist.size(); ++i) {
      const dvec3 along = frames_[i][2];
      twist[i] = glm::dot(along, drags[i].inertia * along);
    }
    return twist;
  }

 private:
  const std::vector<LinkBody>& bodies_;
  std::vector<LinkBody> bent_;
  std::vector<dmat3> frames_;  ///< of the joints
  std::vector<dvec3> angles_, wind_, force_, torque_;
};

}  // namespace

std::vector<double> bentTwistDrag(const std::vector<LinkBody>& bodies, const FactorSettings& mean) {
  if (!(mean.windSpeed > 0)) return std::vector<double>(bodies.size());
  FactorSettings settings = mean;
  settings.windSpeed *= kGust;
  Leaning tree(bodies, settings);
  const std::vector<double> straight = tree.twistDrag();
  for (int round = 0; round < kRounds; ++round) tree.lean();
  std::vector<double> more = tree.twistDrag();
  for (std::size_t i = 0; i < more.size(); ++i) more[i] = std::max(0.0, more[i] - straight[i]);
  return more;
}

}  // namespace windfall::sim
