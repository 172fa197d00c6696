// The analytic solver: each joint's three modes as independent oscillators, stepped exactly (tree_dynamics.md, 5), one
// slot at a time. The inertia is that of the rest pose ("frozen").
#pragma once

#include "kernels/link_oscillator.h"
#include "kernels/link_pose.h"

namespace windfall {

/// Constants of the analytic solver beside the common ones.
enum ModalConstant : std::uint32_t {
  kModes = kCommonConstants,  ///< U, 9: columns; theta = U y
  kSquares = kModes + 9,      ///< lambda, 3: squared frequencies of the modes, 1/s2
  kDampings = kSquares + 3,   ///< b, 3: half damping of the modes, 1/s
  kModalConstants = kDampings + 3
};

enum ModalVariable : std::uint32_t {
  kMode = kCommonVariables,  ///< y, 3
  kModeSpeed = kMode + 3,    ///< y', 3
  kTorque = kModeSpeed + 3,  ///< 3: what the upward pass leaves, joint frame, N m
  kVirial = kTorque + 3,     ///< sum of r . F outboard, N m (5.4)
  kModalVariables = kVirial + 1
};

template <class R>
struct ModalSum {
  static constexpr std::uint32_t kFields = 7;
  V3<R> force, torque;  ///< world axes, torque about the parent's joint
  R virial;
};

/// Composites of everything outboard of the joint at rest, joint frame, for the motion of the axis' base (5.9).
enum AxisConstant : std::uint32_t {
  kMoment = kModalConstants,    ///< 3: sum of m r, kg m
  kInertia6 = kMoment + 3,      ///< 6: xx xy xz yy yz zz, kg m2
  kDragMoment = kInertia6 + 6,  ///< 3: the same with the drag's slope in the place of mass
  kDragInertia = kDragMoment + 3,
  kAxisConstants = kDragInertia + 6
};

/// How the link moves that an axis grows from, world axes.
template <class R>
struct BaseMotion {
  V3<R> place, velocity, spin, acceleration, angularAcceleration;
};

/// Nothing: a joint tells its children no more than its pose.
template <class R>
struct NoMove {
  static constexpr std::uint32_t kFields = 0;
};

/// U y.
template <class R, class Constants>
WINDFALL_HD V3<R> fromModes(const Constants& constant, const V3<R>& y) {
  const auto row = [&](std::uint32_t r) {
    return constant.get(kModes + r) * y.x + constant.get(kModes + 3 + r) * y.y + constant.get(kModes + 6 + r) * y.z;
  };
  return {row(0), row(1), row(2)};
}

struct ModalSolver {
  static constexpr std::uint32_t kSumRow = 8;  ///< numbers of a row of sums
  template <class R>
  using Sum = ModalSum<R>;
  template <class R>
  using Move = NoMove<R>;
  static constexpr std::uint32_t kConstants = kModalConstants, kVariables = kModalVariables;
  static constexpr bool kBase = false;  ///< whether `down` takes the motion of the axis' base

  template <class R, class T, class Constants, class Variables>
  WINDFALL_HD static ModalSum<R> up(const Constants& constant, const Variables& variable, const LinkStep<T>&,
                                    const V3<R>& air, const ModalSum<R>& children) {
    const Turn<R> turn = turnAt<R>(variable, kTurn);
    const Loads<R> own = ownLoads(constant, turn, air);
    const V3<R> force = own.force + children.force, torque = own.torque + children.torque;
    const R virial = children.virial + R(constant.get(kHalf)) * dotOf(alongOf(turn), own.force);
    putVector(variable, kTorque, jointTorque(constant, turn, vectorAt<R>(variable, kAngle), torque));
    variable.put(kVirial, virial);
    const V3<R> arm = vectorAt<R>(variable, kArm);
    return {force, torque + crossOf(arm, force), virial + dotOf(arm, force)};
  }

  template <class R, class T, class Constants, class Variables>
  WINDFALL_HD static NoMove<R> down(const Constants& constant, const Variables& variable, const LinkStep<T>& step,
                                    const Pose<R>& parent, const NoMove<R>&, Pose<R>& pose) {
    solve<R>(constant, variable, step, saturated(constant, vectorAt<R>(variable, kTorque), R(step.saturation)));
    pose = posed(constant, variable, parent, vectorAt<R>(variable, kAngle), vectorAt<R>(variable, kSpeed));
    return {};
  }

  /// Steps the joint's modes under a torque.
  template <class R, class T, class Constants, class Variables>
  WINDFALL_HD static void solve(const Constants& constant, const Variables& variable, const LinkStep<T>& step,
                                const V3<R>& torque) {
    const R outward = largerOf(R(variable.get(kVirial)), R(0.0f)) * R(step.geometric);
    const auto mode = [&](std::uint32_t a, R& y, R& rate) {
      const V3<R> u = vectorAt<R>(constant, kModes + 3 * a);
      // Loads that pull outward stiffen (5.4); implicitly, or light twigs would jitter. The balance stays where it is.
      const R gamma = outward * dotOf(u, u);
      const R stiffer = R(1.0f) + gamma;
      const OscillatorStep<R> s =
          oscillatorStep(R(constant.get(kSquares + a)) * stiffer, R(constant.get(kDampings + a)), R(step.h));
      y = variable.get(kMode + a);
      rate = variable.get(kModeSpeed + a);
      const R balance = (dotOf(u, torque) + gamma * y) / stiffer;
      const R e = y - balance;
      y = balance + e * s.stay + rate * s.gain;
      rate = rate * s.keep - e * s.pull;
    };
    V3<R> y, rate;
    mode(0, y.x, rate.x);
    mode(1, y.y, rate.y);
    mode(2, y.z, rate.z);
    putVector(variable, kMode, y);
    putVector(variable, kModeSpeed, rate);
    putVector(variable, kAngle, fromModes(constant, y));
    putVector(variable, kSpeed, fromModes(constant, rate));
  }
};

/// A symmetric matrix of six fields times a vector.
template <class R, class Constants>
WINDFALL_HD V3<R> symmetricTimes(const Constants& c, std::uint32_t first, const V3<R>& v) {
  const auto row = [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    return c.get(first + x) * v.x + c.get(first + y) * v.y + c.get(first + z) * v.z;
  };
  return {row(0, 1, 2), row(1, 3, 4), row(2, 4, 5)};
}

/// The same where an axis feels how its base moves: fictitious torques, one way (5.9).
struct AxisSolver {
  template <class R>
  using Sum = ModalSum<R>;
  template <class R>
  using Move = NoMove<R>;
  static constexpr std::uint32_t kSumRow = ModalSolver::kSumRow;
  static constexpr std::uint32_t kConstants = kAxisConstants, kVariables = kModalVariables;
  static constexpr bool kBase = true;

  template <class R, class T, class Constants, class Variables>
  WINDFALL_HD static ModalSum<R> up(const Constants& constant, const Variables& variable, const LinkStep<T>& step,
                                    const V3<R>& air, const ModalSum<R>& children) {
    return ModalSolver::up<R>(constant, variable, step, air, children);
  }

  template <class R, class T, class Constants, class Variables>
  WINDFALL_HD static void down(const Constants& constant, const Variables& variable, const LinkStep<T>& step,
                               const Pose<R>& parent, const BaseMotion<R>& base, Pose<R>& pose) {
    const Turn<R> frame = composed(parent.turn, turnAt<R>(constant, kRestTurn));
    const V3<R> d = parent.place + turned(parent.turn, vectorAt<R>(constant, kRestOffset)) - base.place;
    const auto local = [&](const V3<R>& v) { return turnedBack(frame, v); };
    const V3<R> a = local(base.acceleration + crossOf(base.angularAcceleration, d));
    const V3<R> v = local(base.velocity + crossOf(base.spin, d));
    const V3<R> fictitious = crossOf(vectorAt<R>(constant, kMoment), a) +
                             symmetricTimes(constant, kInertia6, local(base.angularAcceleration)) +
                             crossOf(vectorAt<R>(constant, kDragMoment), v) +
                             symmetricTimes(constant, kDragInertia, local(base.spin));
    const V3<R> torque = vectorAt<R>(variable, kTorque) - fictitious;
    ModalSolver::solve<R>(constant, variable, step, saturated(constant, torque, R(step.saturation)));
    pose = posed(constant, variable, parent, vectorAt<R>(variable, kAngle), vectorAt<R>(variable, kSpeed));
  }
};

}  // namespace windfall
