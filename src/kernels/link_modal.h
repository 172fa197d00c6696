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

  template <class R, class T, class Constants, class Variables>
  WINDFALL_HD static ModalSum<R> up(const Constants& constant, const Variables& variable, const LinkStep<T>& step,
                                    const V3<R>& air, const ModalSum<R>& children) {
    const Turn<R> turn = turnAt<R>(variable, kTurn);
    const Loads<R> own = ownLoads(constant, turn, air);
    const V3<R> force = own.force + children.force, torque = own.torque + children.torque;
    const R virial = children.virial + R(constant.get(kHalf)) * dotOf(alongOf(turn), own.force);
    putVector(variable, kTorque,
              bendingTorque(constant, turn, vectorAt<R>(variable, kAngle), torque, R(step.saturation)));
    variable.put(kVirial, virial);
    const V3<R> arm = vectorAt<R>(variable, kArm);
    return {force, torque + crossOf(arm, force), virial + dotOf(arm, force)};
  }

  template <class R, class T, class Constants, class Variables>
  WINDFALL_HD static NoMove<R> down(const Constants& constant, const Variables& variable, const LinkStep<T>& step,
                                    const Pose<R>& parent, const NoMove<R>&, Pose<R>& pose) {
    solve<R>(constant, variable, step, vectorAt<R>(variable, kTorque));
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

}  // namespace windfall
