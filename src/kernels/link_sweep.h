// The passes of the tree solvers slot by slot, for any number type: on the GPU with a thread a slot, in double
// precision for references. Parents gather what their children hand up in the order in which the CPU's loops add it.
#pragma once

#include "kernels/link_coupled.h"
#include "kernels/link_forces.h"
#include "kernels/link_modal.h"

namespace windfall {

/// Children of each slot's link, as rows, in the order of their sums; pointers of the device that runs it.
struct LinkChildren {
  const std::uint32_t* begin = nullptr;  ///< of each slot in `rows`; one more at the end
  const std::uint32_t* rows = nullptr;
};

template <class Struct, class T>
WINDFALL_HD Struct structFrom(const T* numbers) {
  Struct s;
  T* to = reinterpret_cast<T*>(&s);
  for (std::uint32_t k = 0; k < Struct::kFields; ++k) to[k] = numbers[k];
  return s;
}

/// Upward pass at one slot; `slots.sums` holds what each link hands up (by rows of links), `slots.outside` what comes
/// from outside, if anything does.
template <class Solver, class T>
WINDFALL_HD void slotUp(const LinkSlots<T>& slots, const LinkChildren& children, const LinkStep<T>& step,
                        std::uint32_t slot) {
  using Sum = typename Solver::template Sum<T>;
  T sum[Sum::kFields];
  const T* outside =
      slots.outside == nullptr ? nullptr : slots.outside + std::size_t{slots.link[slot]} * Solver::kSumRow;
  for (std::uint32_t k = 0; k < Sum::kFields; ++k) sum[k] = outside == nullptr ? T(0) : outside[k];
  for (std::uint32_t c = children.begin[slot]; c < children.begin[slot + 1]; ++c) {
    const T* part = slots.sums + std::size_t{children.rows[c]} * Solver::kSumRow;
    for (std::uint32_t k = 0; k < Sum::kFields; ++k) sum[k] += part[k];
  }
  const T* air = slots.air + static_cast<std::size_t>(slot / kSlotBlock) * 3 * kSlotBlock + slot % kSlotBlock;
  const Sum out = Solver::template up<T>(
      fieldsOf(slots.constants, Solver::kConstants, slot), fieldsOf(slots.state, Solver::kVariables, slot), step,
      V3<T>{air[0], air[kSlotBlock], air[2 * kSlotBlock]}, structFrom<Sum>(static_cast<const T*>(sum)));
  const T* from = reinterpret_cast<const T*>(&out);
  T* row = slots.sums + std::size_t{slots.link[slot]} * Solver::kSumRow;
  for (std::uint32_t k = 0; k < Sum::kFields; ++k) row[k] = from[k];
}

/// Downward pass at one slot.
template <class Solver, class T>
WINDFALL_HD void slotDown(const LinkSlots<T>& slots, const LinkStep<T>& step, std::uint32_t slot) {
  using Move = typename Solver::template Move<T>;
  const auto poseAt = [](const T* poses, std::uint32_t row) {
    const T* p = poses + std::size_t{row} * kRow;
    const auto vector = [&](int at) { return V3<T>{p[at], p[at + 1], p[at + 2]}; };
    return Pose<T>{{p[0], p[1], p[2], p[3]}, vector(kPosePlace), vector(kPoseVelocity), vector(kPoseSpin)};
  };
  const Pose<T> parent = poseAt(slots.after, slots.parent[slot]);
  const auto constant = fieldsOf(slots.constants, Solver::kConstants, slot);
  const auto variable = fieldsOf(slots.state, Solver::kVariables, slot);
  Pose<T> pose;
  if constexpr (Solver::kBase) {
    const Pose<T> now = poseAt(slots.after, slots.base[slot]), was = poseAt(slots.before, slots.base[slot]);
    const T rate = T(1) / step.h;
    Solver::template down<T>(constant, variable, step, parent,
                             BaseMotion<T>{now.place, now.velocity, now.spin, (now.velocity - was.velocity) * rate,
                                           (now.spin - was.spin) * rate},
                             pose);
  } else {
    Move moved{};
    if constexpr (Move::kFields > 0) {
      moved = structFrom<Move>(static_cast<const T*>(slots.moves + std::size_t{slots.parent[slot]} * kMoveRow));
    }
    const Move move = Solver::template down<T>(constant, variable, step, parent, moved, pose);
    if constexpr (Move::kFields > 0) {
      T* to = slots.moves + std::size_t{slots.link[slot]} * kMoveRow;
      const T* from = reinterpret_cast<const T*>(&move);
      for (std::uint32_t k = 0; k < Move::kFields; ++k) to[k] = from[k];
    }
  }
  T* row = slots.after + std::size_t{slots.link[slot]} * kRow;
  row[0] = pose.turn.x;
  row[1] = pose.turn.y;
  row[2] = pose.turn.z;
  row[3] = pose.turn.w;
  const auto put = [&](int at, const V3<T>& v) {
    row[at] = v.x;
    row[at + 1] = v.y;
    row[at + 2] = v.z;
    row[at + 3] = T(0);
  };
  put(kPosePlace, pose.place);
  put(kPoseVelocity, pose.velocity);
  put(kPoseSpin, pose.spin);
}

}  // namespace windfall
