// The textbook articulated-body algorithm in the current pose (Featherstone, Rigid Body Dynamics Algorithms, 7), with
// all velocity products: the reference that solver C is tested against and timed beside.
#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "sim/bodies.h"

namespace windfall::sim {

/// A tree of spherical joints with springs. T is the scalar. Everything of a link is in its own moving frame.
template <class T>
class ArticulatedTree {
 public:
  using V = glm::vec<3, T>;
  using M = glm::mat<3, 3, T>;
  using Q = glm::qua<T>;

  struct Part {
    int parent = -1;
    T half = 0, mass = 0;
    V offset{0}, stiffness{0}, preStress{0};
    V rotor{0};  ///< inertia on the joint's own turning, kg m2
    Q rest{1, 0, 0, 0};
    M inertia{0}, coupling{0};  ///< of the link alone, about its joint
    Q relative{1, 0, 0, 0};     ///< state: turn of the joint from rest
    V speed{0};                 ///< state: relative angular velocity, link frame
    V force{0};                 ///< external, at the centre of mass, world
    Q rotation{1, 0, 0, 0};     ///< link to world
    V position{0};
    V acceleration{0};  ///< result: rate of `speed`
    M turn{1}, ja{0}, ha{0}, ma{0}, inverse{1};
    V o{0}, v{0}, pn{0}, pf{0}, u{0}, a{0}, b{0};
  };

  /// Structural damping is beta (s) times the stiffness.
  ArticulatedTree(const std::vector<LinkBody>& bodies, T beta) : beta_(beta), parts_(bodies.size()) {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const LinkBody& body = bodies[i];
      Part& part = parts_[i];
      part.parent = body.parent;
      part.half = static_cast<T>(0.5 * body.length);
      part.mass = static_cast<T>(body.mass);
      part.stiffness = V(body.stiffness);
      const bool root = body.parent < 0;
      const LinkBody& parent = bodies[root ? i : static_cast<std::size_t>(body.parent)];
      part.rest = Q(root ? body.rotation : glm::conjugate(parent.rotation) * body.rotation);
      part.offset = V(root ? body.joint : glm::transpose(parent.axes) * (body.joint - parent.joint));
      const M arm = skew(V(0, 0, part.half));
      const T across = static_cast<T>(body.across), along = static_cast<T>(body.along);
      part.inertia = M(across, 0, 0, 0, across, 0, 0, 0, along) + part.mass * glm::transpose(arm) * arm;
      part.coupling = part.mass * arm;
    }
    pose();
  }

  std::vector<Part>& parts() { return parts_; }

  /// World poses from the joints.
  void pose() {
    for (Part& part : parts_) {
      const Q joint = part.rest * part.relative;
      part.turn = glm::mat3_cast(joint);
      if (part.parent < 0) {
        part.rotation = joint;
        part.position = part.offset;
      } else {
        const Part& parent = parts_[static_cast<std::size_t>(part.parent)];
        part.rotation = parent.rotation * joint;
        part.position = parent.position + parent.rotation * part.offset;
      }
    }
  }

  /// Joint accelerations. `h` > 0 takes springs and damping implicitly over h, with velocity products only where they
  /// are asked for (6.4: they bear short steps alone); 0: explicit, everything kept.
  void accelerate(T h, T implicitness = T(0.6), bool products = false) {
    const bool exact = h <= 0 || products;
    const T vh = implicitness * h;
    for (Part& part : parts_) {
      if (part.parent < 0) {
        part.o = part.speed;
        part.v = V(0);
      } else {
        const Part& parent = parts_[static_cast<std::size_t>(part.parent)];
        part.o = part.speed + parent.o * part.turn;  // v * M is M^T v
        part.v = (parent.v + glm::cross(parent.o, part.offset)) * part.turn;
      }
      part.ja = part.inertia;
      part.ha = part.coupling;
      part.ma = M(part.mass);
      const V local = glm::conjugate(part.rotation) * part.force;
      part.pn = -glm::cross(V(0, 0, part.half), local);
      part.pf = -local;
      if (exact) {
        const V spin = part.inertia * part.o + part.coupling * part.v;
        const V momentum = glm::transpose(part.coupling) * part.o + part.mass * part.v;
        part.pn += glm::cross(part.o, spin) + glm::cross(part.v, momentum);
        part.pf += glm::cross(part.o, momentum);
      }
    }
    for (std::size_t i = parts_.size(); i-- > 0;) {
      Part& part = parts_[i];
      const V angle = logarithm(part.relative);
      const V spring = -part.stiffness * (angle + (beta_ + vh) * part.speed) - part.preStress;
      const V diagonal = part.stiffness * (vh * beta_ + vh * vh) + part.rotor;
      part.inverse = glm::inverse(part.ja + M(diagonal.x, 0, 0, 0, diagonal.y, 0, 0, 0, diagonal.z));
      part.u = spring - part.pn;
      if (part.parent < 0) continue;
      const V ca = exact ? glm::cross(part.o, part.speed) : V(0), cl = exact ? glm::cross(part.v, part.speed) : V(0);
      const M jd = part.ja * part.inverse, hd = glm::transpose(part.ha) * part.inverse;
      const M ja = part.ja - jd * part.ja, ha = part.ha - jd * part.ha, ma = part.ma - hd * part.ha;
      const V pn = part.turn * (part.pn + ja * ca + ha * cl + jd * part.u);
      const V pf = part.turn * (part.pf + glm::transpose(ha) * ca + ma * cl + hd * part.u);
      const M back = glm::transpose(part.turn), s = skew(part.offset);
      const M rj = part.turn * ja * back, rh = part.turn * ha * back, rm = part.turn * ma * back;
      const M sh = s * glm::transpose(rh);
      Part& parent = parts_[static_cast<std::size_t>(part.parent)];
      parent.ja += rj + sh + glm::transpose(sh) - s * rm * s;
      parent.ha += rh + s * rm;
      parent.ma += rm;
      parent.pn += pn + glm::cross(part.offset, pf);
      parent.pf += pf;
    }
    for (Part& part : parts_) {
      V a(0), b(0);
      if (part.parent >= 0) {
        const Part& parent = parts_[static_cast<std::size_t>(part.parent)];
        a = parent.a * part.turn;
        b = (parent.b + glm::cross(parent.a, part.offset)) * part.turn;
        if (exact) {
          a += glm::cross(part.o, part.speed);
          b += glm::cross(part.v, part.speed);
        }
      }
      part.acceleration = part.inverse * (part.u - part.ja * a - part.ha * b);
      part.a = a + part.acceleration;
      part.b = b;
    }
  }

  /// One implicit step (springs by the theta method); forces are set and poses are current.
  void stepImplicit(T h, T implicitness = T(0.6), bool products = false) {
    accelerate(h, implicitness, products);
    for (Part& part : parts_) {
      const V speed = part.speed + h * part.acceleration;
      part.relative = turned(part.relative, h * ((1 - implicitness) * part.speed + implicitness * speed));
      part.speed = speed;
    }
    pose();
  }

  /// One Runge-Kutta step of fourth order; `forces` sets the parts' external forces for the current pose.
  void stepRungeKutta(T h, const std::function<void(ArticulatedTree&)>& forces) {
    const std::size_t n = parts_.size();
    std::vector<Q> q(n);
    std::vector<V> w(n), dq(n), dw(n), lastSpeed(n), lastRate(n);
    for (std::size_t i = 0; i < n; ++i) {
      q[i] = parts_[i].relative;
      w[i] = parts_[i].speed;
    }
    const T weight[] = {1, 2, 2, 1}, at[] = {0, T(0.5), T(0.5), 1};
    for (int stage = 0; stage < 4; ++stage) {
      for (std::size_t i = 0; i < n; ++i) {
        if (stage > 0) {
          parts_[i].relative = turned(q[i], at[stage] * h * lastSpeed[i]);
          parts_[i].speed = w[i] + at[stage] * h * lastRate[i];
        }
      }
      pose();
      forces(*this);
      accelerate(0);
      for (std::size_t i = 0; i < n; ++i) {
        lastSpeed[i] = parts_[i].speed;
        lastRate[i] = parts_[i].acceleration;
        dq[i] += weight[stage] * lastSpeed[i];
        dw[i] += weight[stage] * lastRate[i];
      }
    }
    for (std::size_t i = 0; i < n; ++i) {
      parts_[i].relative = turned(q[i], h / 6 * dq[i]);
      parts_[i].speed = w[i] + h / 6 * dw[i];
    }
    pose();
  }

  /// Rotation vector of a joint, rad.
  static V logarithm(const Q& q) {
    const T w = q.w < 0 ? -q.w : q.w;
    const V axis = q.w < 0 ? -V(q.x, q.y, q.z) : V(q.x, q.y, q.z);
    const T s = glm::length(axis);
    return s > T(1e-7) ? axis * (2 * std::atan2(s, w) / s) : axis * T(2);
  }

  /// q, then the rotation vector v in q's own frame.
  static Q turned(const Q& q, const V& v) {
    const T angle = glm::length(v);
    const T s = angle > T(1e-7) ? std::sin(angle / 2) / angle : T(0.5);
    return glm::normalize(q * Q(std::cos(angle / 2), v.x * s, v.y * s, v.z * s));
  }

 private:
  static M skew(const V& v) { return M(0, v.z, -v.y, -v.z, 0, v.x, v.y, -v.x, 0); }

  T beta_;
  std::vector<Part> parts_;
};

}  // namespace windfall::sim
