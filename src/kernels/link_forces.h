// The forces solver of the theses' method A, repaired (tree_dynamics.md, 7), one slot at a time; for comparison. A
// joint knows its own link's inertia and the wind on it, and part of its children's restoring torque; the wind on the
// crown does not reach the trunk.
#pragma once

#include "kernels/link_oscillator.h"
#include "kernels/link_pose.h"

namespace windfall {

enum ForcesConstant : std::uint32_t {
  kInertia = kCommonConstants,  ///< m l2 / 3 across the branch, kg m2
  kTwistInertia,                ///< along it
  kLinearDamping,               ///< structural and of the air, N m s
  kForcesTwistDamping,
  kQuadraticDamping,  ///< mu of -mu w |w|, N m s2
  kPropagation,       ///< k_i: part of the joint's restoring torque that the parent feels
  kForcesConstants
};

inline constexpr std::uint32_t kForcesVariables = kCommonVariables + 3;
inline constexpr std::uint32_t kForcesTorque = kCommonVariables;  ///< 3: what the upward pass leaves, joint frame, N m

template <class R>
struct ForcesSum {
  static constexpr std::uint32_t kFields = 3;
  V3<R> torque;  ///< rest frame of the parent
};

struct ForcesSolver {
  static constexpr std::uint32_t kSumRow = 8;  ///< numbers of a row of sums
  template <class R>
  using Sum = ForcesSum<R>;
  template <class R>
  struct Move {
    static constexpr std::uint32_t kFields = 0;
  };
  static constexpr std::uint32_t kConstants = kForcesConstants, kVariables = kForcesVariables;
  static constexpr bool kBase = false;

  template <class R, class T, class Constants, class Variables>
  WINDFALL_HD static ForcesSum<R> up(const Constants& constant, const Variables& variable, const LinkStep<T>&,
                                     const V3<R>& air, const ForcesSum<R>& children) {
    const Turn<R> turn = turnAt<R>(variable, kTurn);
    const V3<R> angle = vectorAt<R>(variable, kAngle);
    const V3<R> along = alongOf(turn);
    const V3<R> drag = dragOf(R(constant.get(kWoodDrag)), R(constant.get(kLeafDrag)), along, air);
    const V3<R> wind = turnedBack(turn, crossOf(along * R(constant.get(kHalf)), drag));
    putVector(variable, kForcesTorque, turned(exponentialOf(angle * shownPart(angle)), wind + children.torque));
    const R share = constant.get(kPropagation);
    const R across = share * constant.get(kBending), twist = share * constant.get(kTwist);
    return {turned(turnAt<R>(constant, kRestTurn), V3<R>{angle.x * across, angle.y * across, angle.z * twist})};
  }

  template <class R, class T, class Constants, class Variables>
  WINDFALL_HD static Move<R> down(const Constants& constant, const Variables& variable, const LinkStep<T>& step,
                                  const Pose<R>& parent, const Move<R>&, Pose<R>& pose) {
    const V3<R> torque = saturated(constant, vectorAt<R>(variable, kForcesTorque), R(step.saturation));
    V3<R> angle = vectorAt<R>(variable, kAngle), speed = vectorAt<R>(variable, kSpeed);
    // -mu w |w| with |w| of the step's start is a damping, whatever the speed.
    const R quadratic = R(constant.get(kQuadraticDamping)) * squareRoot(dotOf(speed, speed));
    const auto axis = [&](const R& k, const R& inertia, const R& damping, const R& load, R& x, R& v) {
      const OscillatorStep<R> s = oscillatorStep(k / inertia, R(0.5f) * (damping + quadratic) / inertia, R(step.h));
      const R balance = load / k, e = x - balance;
      x = balance + e * s.stay + v * s.gain;
      v = v * s.keep - e * s.pull;
    };
    const R k = constant.get(kBending), i = constant.get(kInertia), d = constant.get(kLinearDamping);
    axis(k, i, d, torque.x, angle.x, speed.x);
    axis(k, i, d, torque.y, angle.y, speed.y);
    axis(R(constant.get(kTwist)), R(constant.get(kTwistInertia)), R(constant.get(kForcesTwistDamping)), torque.z,
         angle.z, speed.z);
    putVector(variable, kAngle, angle);
    putVector(variable, kSpeed, speed);
    pose = posed(constant, variable, parent, angle, speed);
    return {};
  }
};

}  // namespace windfall
