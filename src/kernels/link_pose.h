// What all tree solvers share: the loads of a link by wind and weight, the saturation of torques, the pose of a link on
// its posed parent (tree_dynamics.md, 1, 2.4, 5.5). R is the number type of link_algebra.h.
#pragma once

#include "kernels/link_algebra.h"
#include "kernels/link_slots.h"

namespace windfall {

/// m/s at which leaves turn out of the wind (2.4).
inline constexpr float kReconfigurationSpeed = 5.0f;

/// Pose and motion of a link in the world.
template <class R>
struct Pose {
  Turn<R> turn;
  V3<R> place, velocity, spin;
};

template <class R>
struct Loads {
  V3<R> force, torque;  ///< N; N m about the joint
};

/// Drag of wood and leaves in the air velocity u, N: F = C(u) u. `wood`: over speed across times speed, N s2/m2;
/// `leaves`: the same at low speed. The branch's own velocity stays out (5.8).
template <class R>
WINDFALL_HD V3<R> dragOf(const R& wood, const R& leaves, const V3<R>& along, const V3<R>& u) {
  const R square = dotOf(u, u);
  const R in = dotOf(u, along);
  const R across = squareRoot(largerOf(square - in * in, R(0.0f)));
  const R gentle = squareRoot(square / (R(1.0f) + square * R(1 / (kReconfigurationSpeed * kReconfigurationSpeed))));
  return u * (wood * across + leaves * gentle);
}

/// Wind and weight on a link that is turned by `turn`.
template <class R, class Constants>
WINDFALL_HD Loads<R> ownLoads(const Constants& constant, const Turn<R>& turn, const V3<R>& air) {
  const V3<R> along = alongOf(turn);
  Loads<R> loads;
  loads.force = dragOf(R(constant.get(kWoodDrag)), R(constant.get(kLeafDrag)), along, air);
  loads.force.y = loads.force.y - constant.get(kWeight);
  loads.torque = crossOf(along * R(constant.get(kHalf)), loads.force);
  return loads;
}

/// A torque in world axes seen in the joint frame, which turns with the parent but not with the joint's own angle, less
/// what the rest pose carries.
template <class R, class Constants>
WINDFALL_HD V3<R> jointTorque(const Constants& constant, const Turn<R>& turn, const V3<R>& angle, const V3<R>& world) {
  const V3<R> joint = turned(exponentialOf(angle * shownPart(angle)), turnedBack(turn, world));
  return joint - vectorAt<R>(constant, kPreStress);
}

/// A joint's torque with its size bounded: progressive stiffening past theta_max (5.5).
template <class R, class Constants>
WINDFALL_HD V3<R> saturated(const Constants& constant, const V3<R>& torque, const R& largest) {
  const R bending = constant.get(kBending);
  const R x = torque.x / bending, y = torque.y / bending, z = torque.z / constant.get(kTwist);
  const R q = (x * x + y * y + z * z) / (largest * largest);
  // Beyond 1e18 the square would be no number.
  const R p = smallerOf(q, R(1e18f));
  return torque * (R(1.0f) / squareRoot(squareRoot(R(1.0f) + p * p)));
}

/// Poses a link by its joint's angle and speed, and keeps what the next step's upward pass needs.
template <class R, class Constants, class Variables>
WINDFALL_HD Pose<R> posed(const Constants& constant, const Variables& variable, const Pose<R>& parent,
                          const V3<R>& angle, const V3<R>& speed) {
  const R shown = shownPart(angle);
  const Turn<R> joint = exponentialOf(angle * shown);
  const Turn<R> frame = composed(parent.turn, turnAt<R>(constant, kRestTurn));
  const V3<R> arm = turned(parent.turn, vectorAt<R>(constant, kRestOffset));
  // A joint at its largest shown angle does not move.
  const R moves = select(shown < R(1.0f), R(0.0f), R(1.0f));
  Pose<R> pose;
  pose.turn = unitOf(composed(frame, joint));
  pose.place = parent.place + arm;
  pose.velocity = parent.velocity + crossOf(parent.spin, arm);
  pose.spin = parent.spin + turned(frame, speed * moves);
  variable.put(kTurn, pose.turn.x);
  variable.put(kTurn + 1, pose.turn.y);
  variable.put(kTurn + 2, pose.turn.z);
  variable.put(kTurn + 3, pose.turn.w);
  putVector(variable, kArm, arm);
  return pose;
}

}  // namespace windfall
