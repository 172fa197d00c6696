// The analytic method as published: composite inertias of the current pose in every step (tree_dynamics.md, 5.1, 5.2,
// 5.6), with or without the guard of its energy. For tests of why the inertia is frozen; no load, no damping.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "kernels/link_oscillator.h"
#include "sim/articulated.h"
#include "sim/bodies.h"
#include "sim/symmetric_eigen.h"

namespace windfall::test {

class MovingInertiaTree {
 public:
  MovingInertiaTree(const sim::Tree& tree, bool guarded)
      : bodies_(sim::bodiesOf(tree)),
        rest_(bodies_),
        angle_(bodies_.size()),
        speed_(bodies_.size()),
        kept_(bodies_.size()),
        guarded_(guarded) {}

  std::size_t size() const { return bodies_.size(); }
  void setAngle(std::size_t i, const glm::dvec3& angle) { angle_[i] = angle; }

  /// One step; the energy at its end, with the inertia that it was made with, J.
  double step(double h) {
    pose();
    const std::vector<sim::Composite> composites = sim::compositesOf(bodies_);
    double energy = 0;
    for (std::size_t i = 0; i < size(); ++i) {
      const glm::dmat3 frame = glm::mat3_cast(frames_[i]);
      const glm::dmat3 inertia = glm::transpose(frame) * composites[i].inertia * frame;
      const glm::dvec3 k = bodies_[i].stiffness, s = 1.0 / glm::sqrt(k);
      const double now = 0.5 * glm::dot(speed_[i], inertia * speed_[i]);
      if (guarded_ && stepped_ && now > kept_[i]) speed_[i] *= std::sqrt(kept_[i] / now);
      glm::dmat3 scaled = inertia, vectors;
      for (int c = 0; c < 3; ++c) {
        for (int r = 0; r < 3; ++r) scaled[c][r] *= s[c] * s[r];
      }
      glm::dvec3 mu;
      sim::symmetricEigen(scaled, mu, vectors);
      glm::dvec3 angle(0), speed(0);
      for (int a = 0; a < 3; ++a) {
        const glm::dvec3 u = s * vectors[a];
        const OscillatorStep<double> exact = oscillatorStep(1 / std::max(mu[a], 1e-300), 0.0, h);
        const double y = glm::dot(u, k * angle_[i]), rate = glm::dot(u, k * speed_[i]);
        angle += u * (y * exact.stay + rate * exact.gain);
        speed += u * (rate * exact.keep - y * exact.pull);
      }
      angle_[i] = angle;
      speed_[i] = speed;
      kept_[i] = 0.5 * glm::dot(speed, inertia * speed);
      energy += kept_[i] + 0.5 * glm::dot(angle, k * angle);
    }
    stepped_ = true;
    return energy;
  }

 private:
  void pose() {
    frames_.resize(size());
    for (std::size_t i = 0; i < size(); ++i) {
      const sim::LinkBody& rest = rest_[i];
      sim::LinkBody& body = bodies_[i];
      frames_[i] = rest.rotation;
      if (rest.parent >= 0) {
        const auto p = static_cast<std::size_t>(rest.parent);
        frames_[i] = bodies_[p].rotation * (glm::conjugate(rest_[p].rotation) * rest.rotation);
        body.joint =
            bodies_[p].joint + bodies_[p].axes * (glm::transpose(rest_[p].axes) * (rest.joint - rest_[p].joint));
      }
      body.rotation = sim::ArticulatedTree<double>::turned(frames_[i], angle_[i]);
      body.axes = glm::mat3_cast(body.rotation);
    }
  }

  std::vector<sim::LinkBody> bodies_;
  const std::vector<sim::LinkBody> rest_;
  std::vector<glm::dquat> frames_;
  std::vector<glm::dvec3> angle_, speed_;
  std::vector<double> kept_;  ///< kinetic energy at the end of the last step, J
  bool guarded_, stepped_ = false;
};

}  // namespace windfall::test
