// The prefactored, two-way coupled solver (tree_dynamics.md, 6.2), one slot at a time.
#pragma once

#include "kernels/link_pose.h"

namespace windfall {

/// Constants of the coupled solver beside the common ones.
enum CoupledConstant : std::uint32_t {
  kDragSlope = kCommonConstants,  ///< c: dF/dv at the level of the mean wind, N s/m
  kBendingSpeed,                  ///< (theta h + beta) K + theta h g: what multiplies the joint's speed, N m s
  kTwistSpeed,
  kInverse,                  ///< Di, 6: xx xy xz yy yz zz
  kTransfer = kInverse + 6,  ///< W, 18: rows of W_top, then of W_bot
  kCoupledConstants = kTransfer + 18
};

/// State of the coupled solver beside the common one; o and v are of the linear system, in the link's own rest frame.
enum CoupledVariable : std::uint32_t {
  kSpin = kCommonVariables,  ///< o, 3: angular velocity, rad/s
  kVelocity = kSpin + 3,     ///< v, 3: of the joint, m/s
  kAnswer = kVelocity + 3,   ///< u, 3: what the upward pass leaves for the downward one, rad/s2
  kCoupledVariables = kAnswer + 3
};

/// What a subtree hands to its parent.
template <class R>
struct CoupledSum {
  static constexpr std::uint32_t kFields = 12;
  V3<R> force, torque;          ///< world axes, torque about the parent's joint
  V3<R> biasTorque, biasForce;  ///< rest frame of the parent
};

/// What a joint hands to its children: acceleration of the linear system, rest frame of the link.
template <class R>
struct CoupledMove {
  static constexpr std::uint32_t kFields = 6;
  V3<R> angular, linear;
};

struct CoupledSolver {
  static constexpr std::uint32_t kSumRow = 16;  ///< numbers of a row of sums
  template <class R>
  using Sum = CoupledSum<R>;
  template <class R>
  using Move = CoupledMove<R>;
  static constexpr std::uint32_t kConstants = kCoupledConstants, kVariables = kCoupledVariables;
  static constexpr bool kBase = false;

  /// Loads and the joint's answer to them, all children being summed in `children`; what goes to the parent.
  template <class R, class T, class Constants, class Variables>
  WINDFALL_HD static CoupledSum<R> up(const Constants& constant, const Variables& variable, const LinkStep<T>& step,
                                      const V3<R>& air, const CoupledSum<R>& children) {
    const V3<R> angle = vectorAt<R>(variable, kAngle), speed = vectorAt<R>(variable, kSpeed);
    const Turn<R> turn = turnAt<R>(variable, kTurn);
    const Loads<R> own = ownLoads(constant, turn, air);
    const V3<R> force = own.force + children.force, torque = own.torque + children.torque;

    // Linear drag of the link's own motion at its middle, (0, 0, half) from the joint.
    const R half = constant.get(kHalf), slope = constant.get(kDragSlope);
    const V3<R> spin = vectorAt<R>(variable, kSpin), velocity = vectorAt<R>(variable, kVelocity);
    const V3<R> drag = V3<R>{velocity.x + spin.y * half, velocity.y - spin.x * half, velocity.z} * slope;
    const V3<R> biasForce = children.biasForce + drag;
    const V3<R> biasTorque = children.biasTorque + V3<R>{-(half * drag.y), half * drag.x, R(0.0f)};

    const V3<R> bending = saturated(constant, jointTorque(constant, turn, angle, torque), R(step.saturation));
    const R k = constant.get(kBending), b = constant.get(kBendingSpeed);
    const V3<R> right{bending.x - k * angle.x - b * speed.x - biasTorque.x,
                      bending.y - k * angle.y - b * speed.y - biasTorque.y,
                      bending.z - constant.get(kTwist) * angle.z - constant.get(kTwistSpeed) * speed.z - biasTorque.z};
    const auto row = [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
      return constant.get(x) * right.x + constant.get(y) * right.y + constant.get(z) * right.z;
    };
    putVector(variable, kAnswer,
              V3<R>{row(kInverse, kInverse + 1, kInverse + 2), row(kInverse + 1, kInverse + 3, kInverse + 4),
                    row(kInverse + 2, kInverse + 4, kInverse + 5)});
    const auto transfer = [&](std::uint32_t first) {
      return V3<R>{row(first, first + 1, first + 2), row(first + 3, first + 4, first + 5),
                   row(first + 6, first + 7, first + 8)};
    };
    const Turn<R> restTurn = turnAt<R>(constant, kRestTurn);
    const V3<R> turnedForce = turned(restTurn, biasForce);
    CoupledSum<R> out;
    out.force = force;
    out.torque = torque + crossOf(vectorAt<R>(variable, kArm), force);
    out.biasTorque =
        turned(restTurn, biasTorque) + crossOf(vectorAt<R>(constant, kRestOffset), turnedForce) + transfer(kTransfer);
    out.biasForce = turnedForce + transfer(kTransfer + 9);
    return out;
  }

  /// Moves the joint, its parent being done.
  template <class R, class T, class Constants, class Variables>
  WINDFALL_HD static CoupledMove<R> down(const Constants& constant, const Variables& variable, const LinkStep<T>& step,
                                         const Pose<R>& parent, const CoupledMove<R>& moved, Pose<R>& pose) {
    const V3<R>&a = moved.angular, &b = moved.linear;
    const auto column = [&](std::uint32_t c) {
      const auto w = [&](std::uint32_t r) { return constant.get(kTransfer + c + 3 * r); };
      return w(0) * a.x + w(1) * a.y + w(2) * a.z + w(3) * b.x + w(4) * b.y + w(5) * b.z;
    };
    const V3<R> eta = vectorAt<R>(variable, kAnswer) - V3<R>{column(0), column(1), column(2)};
    const Turn<R> restTurn = turnAt<R>(constant, kRestTurn);
    CoupledMove<R> move;
    move.angular = turnedBack(restTurn, a) + eta;
    move.linear = turnedBack(restTurn, b + crossOf(a, vectorAt<R>(constant, kRestOffset)));

    const R h(step.h);
    const V3<R> before = vectorAt<R>(variable, kSpeed);
    const V3<R> speed = before + eta * h;
    const V3<R> angle =
        vectorAt<R>(variable, kAngle) + (before * R(T(1) - step.implicitness) + speed * R(step.implicitness)) * h;
    putVector(variable, kAngle, angle);
    putVector(variable, kSpeed, speed);
    putVector(variable, kSpin, vectorAt<R>(variable, kSpin) + move.angular * h);
    putVector(variable, kVelocity, vectorAt<R>(variable, kVelocity) + move.linear * h);
    pose = posed(constant, variable, parent, angle, speed);
    return move;
  }
};

}  // namespace windfall
