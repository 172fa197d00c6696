// How the tree solvers store links: in blocks of 16 slots, each field of a block side by side, so that the CPU's wide
// registers and the GPU's warps read without gaps. Slots stand level by level from the roots of a part; what passes
// between parent and child goes through rows, one a link, in the scene's order.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernels/link_state.h"
#include "kernels/math.h"

namespace windfall {

inline constexpr std::uint32_t kSlotBlock = 16;  ///< slots of a block
inline constexpr std::uint32_t kRow = 16;  ///< numbers of a row: a LinkState, or what a subtree hands to its parent
static_assert(sizeof(LinkState) == kRow * sizeof(float));

/// Where the fields of a LinkState stand in its row.
enum PoseRow { kPoseTurn = 0, kPosePlace = 4, kPoseVelocity = 8, kPoseSpin = 12 };

/// What joints hand to their children stands in rows of this length.
inline constexpr std::uint32_t kMoveRow = 8;

/// Constants of a step.
template <class T>
struct LinkStep {
  T h = T(1.0 / 60);        ///< s
  T implicitness = T(0.6);  ///< theta of the note's 6.1, 0.5..1
  T saturation = T(0.8);    ///< theta_max, rad
  T geometric = T(1);       ///< 1: loads that pull outward stiffen the analytic joints (5.4); 0: not
};

/// Everything that a pass over links needs; pointers of the device that runs it. Behind the rows of the links stand
/// those of the ground, which roots stand on, and of slots without a link.
template <class T>
struct LinkSlots {
  const std::uint32_t* link = nullptr;    ///< row of each slot's own link
  const std::uint32_t* parent = nullptr;  ///< row of its parent
  const std::uint32_t* target = nullptr;  ///< row that its sums are added to: the parent's, or one of its own
  const std::uint32_t* base = nullptr;    ///< row of the link that its axis grows from, where a solver asks for it
  const T* constants = nullptr;           ///< blocks of constantFields
  T* state = nullptr;                     ///< blocks of stateFields
  const T* air = nullptr;                 ///< blocks of 3: air velocity at the link's middle, m/s
  T* sums = nullptr;                      ///< rows: what children hand up; between steps only loads from outside
  const T* outside = nullptr;             ///< rows as of sums, or none: loads from outside (link_sweep.h alone)
  T* moves = nullptr;                     ///< rows of kMoveRow: what parents hand down
  const T* before = nullptr;              ///< rows: poses at the start of the step
  T* after = nullptr;                     ///< rows: poses at its end
  std::uint32_t constantFields = 0, stateFields = 0;
};

/// Constants that every solver has. "Joint frame": moves with the parent; at rest it is the link's own frame.
enum LinkConstant : std::uint32_t {
  kHalf,                        ///< half the length, m
  kWeight,                      ///< m |g|, N
  kWoodDrag,                    ///< drag of the wood over speed across times speed, N s2/m2
  kLeafDrag,                    ///< the same of the leaves at low speed
  kRestOffset,                  ///< p0, 3: joint in the parent's frame, m (a root: in the world)
  kRestTurn = kRestOffset + 3,  ///< q0, 4: link to parent at rest (a root: to the world)
  kBending = kRestTurn + 4,     ///< K across the branch, N m/rad
  kTwist,                       ///< K along it
  kPreStress,                   ///< tau0, 3: torque that the rest pose carries, joint frame, N m
  kCommonConstants = kPreStress + 3
};

/// State that every solver has.
enum LinkVariable : std::uint32_t {
  kAngle,               ///< theta, 3: rotation vector about the rest pose, joint frame, rad
  kSpeed = kAngle + 3,  ///< its rate, rad/s
  kTurn = kSpeed + 3,   ///< 4: world rotation of the link
  kArm = kTurn + 4,     ///< 3: from the parent's joint to this one, world axes, m
  kCommonVariables = kArm + 3
};

/// The fields of one slot, for code that goes slot by slot.
template <class T>
struct SlotFields {
  T* first;
  WINDFALL_HD T get(std::uint32_t field) const { return first[field * kSlotBlock]; }
  WINDFALL_HD void put(std::uint32_t field, T value) const { first[field * kSlotBlock] = value; }
};

template <class T>
WINDFALL_HD SlotFields<T> fieldsOf(T* blocks, std::uint32_t fields, std::uint32_t slot) {
  return {blocks + static_cast<std::size_t>(slot / kSlotBlock) * fields * kSlotBlock + slot % kSlotBlock};
}

}  // namespace windfall
