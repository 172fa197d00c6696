// The passes of the tree solvers over blocks of slots on the CPU, in wide registers of the best instruction set that
// the machine has; all give the same bits.
#pragma once

#include <cstdint>

#include "kernels/link_slots.h"
#include "kernels/wind.h"

namespace windfall {

/// Blocks [begin, end) of slots.
using LinkPass = void (*)(const LinkSlots<float>& slots, const LinkStep<float>& step, std::uint32_t begin,
                          std::uint32_t end);

/// Samples the wind at the links of blocks [begin, end), in the poses of slots.before, into blocks of 3 fields.
using LinkAir = void (*)(const LinkSlots<float>& slots, const WindView& wind, std::uint32_t begin, std::uint32_t end,
                         float* air);

/// Both passes of a solver: up from the last block to the first, down from the first to the last.
struct LinkPasses {
  LinkPass up, down;
};

/// The passes as compiled for one instruction set.
struct LinkLoops {
  const char* name;  ///< "x86-64-v4"
  LinkPasses coupled, modal, axis, forces;
  LinkAir air;
};

/// The best of this machine.
const LinkLoops& linkLoops();
/// All that run on this machine, the plainest first; what tests compare.
struct LinkLoopsList {
  const LinkLoops* all[3];
  int count;
};
LinkLoopsList everyLinkLoops();

}  // namespace windfall
