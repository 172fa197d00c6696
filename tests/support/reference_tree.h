// The slow reference of the tree solvers: the full nonlinear articulated-body dynamics (tree_dynamics.md, 6.4) with
// springs, weight and wind, in double precision.
#pragma once

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "kernels/link_pose.h"
#include "sim/articulated.h"
#include "sim/factor.h"

namespace windfall::test {

/// How the air brakes a link that moves.
enum class AirBrake {
  Relative,  ///< F(u - v), as it is
  Linear     ///< F(u) - c v with the solvers' own c, where only the joints' dynamics are compared
};

class ReferenceTree {
 public:
  using Bodies = sim::ArticulatedTree<double>;
  /// Velocity of the air at a place, m/s, world.
  using Air = std::function<glm::dvec3(const glm::dvec3&)>;

  ReferenceTree(const sim::Tree& tree, const sim::FactorSettings& settings, AirBrake brake)
      : settings_(settings),
        brake_(brake),
        bodies_(sim::bodiesOf(tree)),
        tree_(bodies_, 2 * settings.dampingRatio / (2 * std::numbers::pi * sim::firstFrequency(bodies_))),
        spin_(bodies_.size()),
        velocity_(bodies_.size()) {
    const std::vector<sim::Composite> composites = sim::compositesOf(bodies_);
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      rest_.push_back(glm::transpose(bodies_[i].axes) * glm::cross(composites[i].moment, settings.gravity));
      slope_.push_back(sim::dragSlope(bodies_[i], settings));
      if (settings.twistFloor) tree_.parts()[i].rotor.z = sim::twistFloor(bodies_[i], composites[i]);
    }
  }

  std::size_t size() const { return bodies_.size(); }
  const std::vector<sim::LinkBody>& bodies() const { return bodies_; }
  /// Sets a joint to a rotation vector; `pose` must follow.
  void setJoint(std::size_t i, const glm::dvec3& angle) {
    tree_.parts()[i].relative = Bodies::turned({1, 0, 0, 0}, angle);
  }
  void pose() { tree_.pose(); }

  /// Springs by the theta method, everything else explicit: for short steps.
  void stepImplicit(double h, double implicitness, const Air& air) {
    load(air);
    tree_.stepImplicit(h, implicitness, true);
  }
  void stepRungeKutta(double h, const Air& air) {
    tree_.stepRungeKutta(h, [&](Bodies&) { load(air); });
  }

  glm::dvec3 place(std::size_t i) const { return part(i).position; }
  glm::dquat turn(std::size_t i) const { return part(i).rotation; }  ///< link to world
  glm::dvec3 tip(std::size_t i) const {
    return part(i).position + part(i).rotation * glm::dvec3(0, 0, 2 * part(i).half);
  }

  /// Kinetic, elastic and potential energy, J.
  double energy() {
    move();
    double sum = 0;
    for (std::size_t i = 0; i < size(); ++i) {
      const Bodies::Part& p = part(i);
      const glm::dvec3 arm = p.rotation * glm::dvec3(0, 0, p.half);
      const glm::dvec3 v = velocity_[i] + glm::cross(spin_[i], arm);
      const glm::dvec3 turn = glm::conjugate(p.rotation) * spin_[i];
      const glm::dvec3 angle = Bodies::logarithm(p.relative);
      const sim::LinkBody& body = bodies_[i];
      sum += 0.5 * (body.mass * glm::dot(v, v) + body.across * (turn.x * turn.x + turn.y * turn.y) +
                    body.along * turn.z * turn.z + glm::dot(angle, body.stiffness * angle) +
                    glm::dot(p.speed, p.rotor * p.speed)) -
             body.mass * glm::dot(settings_.gravity, p.position + arm);
    }
    return sum;
  }
  /// Weight without the torques that carry it at rest.
  void dropPreStress() { rest_.assign(rest_.size(), glm::dvec3(0)); }

 private:
  const Bodies::Part& part(std::size_t i) const { return const_cast<Bodies&>(tree_).parts()[i]; }

  void move() {
    const std::vector<Bodies::Part>& parts = tree_.parts();
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const Bodies::Part& p = parts[i];
      spin_[i] = p.rotation * p.speed;
      velocity_[i] = glm::dvec3(0);
      if (p.parent < 0) continue;
      const auto above = static_cast<std::size_t>(p.parent);
      spin_[i] += spin_[above];
      velocity_[i] = velocity_[above] + glm::cross(spin_[above], p.position - parts[above].position);
    }
  }

  void load(const Air& air) {
    move();
    std::vector<Bodies::Part>& parts = tree_.parts();
    for (std::size_t i = 0; i < parts.size(); ++i) {
      Bodies::Part& p = parts[i];
      const glm::dvec3 along = p.rotation * glm::dvec3(0, 0, 1);
      const glm::dvec3 middle = p.position + along * p.half;
      const glm::dvec3 v = velocity_[i] + glm::cross(spin_[i], along * p.half);
      const glm::dvec3 u = brake_ == AirBrake::Relative ? air(middle) - v : air(middle);
      const sim::LinkBody& body = bodies_[i];
      const V3<double> drag =
          dragOf<double>(body.woodDrag, body.leafDrag, {along.x, along.y, along.z}, {u.x, u.y, u.z});
      p.force = glm::dvec3(drag.x, drag.y, drag.z) + body.mass * settings_.gravity;
      if (brake_ == AirBrake::Linear) p.force -= slope_[i] * v;
      // Kept in the joint's frame, wanted in the link's.
      p.preStress = glm::conjugate(p.relative) * rest_[i];
    }
  }

  sim::FactorSettings settings_;
  AirBrake brake_;
  std::vector<sim::LinkBody> bodies_;
  std::vector<glm::dvec3> rest_;
  Bodies tree_;
  std::vector<double> slope_;
  std::vector<glm::dvec3> spin_, velocity_;
};

}  // namespace windfall::test
