// The passes for one instruction set; each link_loops_*.cpp includes this once.
#pragma once

#include "kernels/link_air_body.h"
#include "kernels/link_coupled.h"
#include "kernels/link_forces.h"
#include "kernels/link_lanes.h"
#include "kernels/link_loops.h"
#include "kernels/link_modal.h"

namespace windfall {
inline namespace WINDFALL_LANES {

/// Numbers of a struct of Lanes as the first fields of rows, and back.
template <class Struct, std::uint32_t Length>
WINDFALL_INLINE Struct fromRows(const Rows<Length>& rows) {
  Struct s;
  if constexpr (Struct::kFields > 0) __builtin_memcpy(&s, rows.field, sizeof s);
  return s;
}
template <std::uint32_t Length, class Struct>
WINDFALL_INLINE Rows<Length> toRows(const Struct& s) {
  Rows<Length> rows;
  for (std::uint32_t f = Struct::kFields; f < Length; ++f) rows.field[f] = Lanes(0.0f);
  if constexpr (Struct::kFields > 0) __builtin_memcpy(rows.field, &s, sizeof s);
  return rows;
}

template <class Solver>
void upPass(const LinkSlots<float>& slots, const LinkStep<float>& step, std::uint32_t begin, std::uint32_t end) {
  using Sum = typename Solver::template Sum<Lanes>;
  constexpr std::uint32_t kWidth = kNativeLanes;
  for (std::uint32_t first = end * kSlotBlock; first > begin * kSlotBlock;) {
    first -= kWidth;
    const std::size_t block = first / kSlotBlock, lane = first % kSlotBlock;
    const LaneConstants constant{slots.constants + block * Solver::kConstants * kSlotBlock + lane};
    const LaneFields variable{slots.state + block * Solver::kVariables * kSlotBlock + lane};
    const LaneConstants air{slots.air + block * 3 * kSlotBlock + lane};
    Rows<Solver::kSumRow> children;
    children.template read<true>(slots.sums, slots.link + first);
    const Sum out =
        Solver::template up<Lanes>(constant, variable, step, vectorAt<Lanes>(air, 0), fromRows<Sum>(children));
    toRows<Solver::kSumRow>(out).template write<true>(slots.sums, slots.target + first);
  }
}

WINDFALL_INLINE Pose<Lanes> posesAt(const float* poses, const std::uint32_t* index) {
  Rows<kRow> rows;
  rows.template read<false>(poses, index);
  const auto vector = [&](int at) { return V3<Lanes>{rows.field[at], rows.field[at + 1], rows.field[at + 2]}; };
  return {{rows.field[0], rows.field[1], rows.field[2], rows.field[3]},
          vector(kPosePlace),
          vector(kPoseVelocity),
          vector(kPoseSpin)};
}

template <class Solver>
void downPass(const LinkSlots<float>& slots, const LinkStep<float>& step, std::uint32_t begin, std::uint32_t end) {
  using Move = typename Solver::template Move<Lanes>;
  constexpr std::uint32_t kWidth = kNativeLanes;
  for (std::uint32_t first = begin * kSlotBlock; first < end * kSlotBlock; first += kWidth) {
    const std::size_t block = first / kSlotBlock, lane = first % kSlotBlock;
    const LaneConstants constant{slots.constants + block * Solver::kConstants * kSlotBlock + lane};
    const LaneFields variable{slots.state + block * Solver::kVariables * kSlotBlock + lane};
    const Pose<Lanes> parent = posesAt(slots.after, slots.parent + first);
    Pose<Lanes> pose;
    if constexpr (Solver::kBase) {
      const Pose<Lanes> now = posesAt(slots.after, slots.base + first), was = posesAt(slots.before, slots.base + first);
      const Lanes rate(1 / step.h);
      Solver::template down<Lanes>(
          constant, variable, step, parent,
          BaseMotion<Lanes>{now.place, now.velocity, now.spin, (now.velocity - was.velocity) * rate,
                            (now.spin - was.spin) * rate},
          pose);
    } else {
      Rows<kMoveRow> moved;
      if constexpr (Move::kFields > 0) moved.template read<false>(slots.moves, slots.parent + first);
      const Move move = Solver::template down<Lanes>(constant, variable, step, parent, fromRows<Move>(moved), pose);
      if constexpr (Move::kFields > 0) toRows<kMoveRow>(move).template write<false>(slots.moves, slots.link + first);
    }
    const Lanes none(0.0f);
    const Rows<kRow> out{{pose.turn.x, pose.turn.y, pose.turn.z, pose.turn.w, pose.place.x, pose.place.y, pose.place.z,
                          none, pose.velocity.x, pose.velocity.y, pose.velocity.z, none, pose.spin.x, pose.spin.y,
                          pose.spin.z, none}};
    out.template write<false>(slots.after, slots.link + first);
  }
}

inline constexpr LinkPasses kCoupledPasses{upPass<CoupledSolver>, downPass<CoupledSolver>};
inline constexpr LinkPasses kModalPasses{upPass<ModalSolver>, downPass<ModalSolver>};
inline constexpr LinkPasses kAxisPasses{upPass<AxisSolver>, downPass<AxisSolver>};
inline constexpr LinkPasses kForcesPasses{upPass<ForcesSolver>, downPass<ForcesSolver>};

}  // namespace WINDFALL_LANES
}  // namespace windfall
