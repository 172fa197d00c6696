// A step of many leaves on one core, in blocks, with the best instruction set that the machine has.
#pragma once

#include <cstdint>

#include "kernels/leaf_arrays.h"

namespace windfall {

/// Leaves that are looked at together; also the unit by which looking around is spread over steps.
inline constexpr std::uint32_t kLeafBlock = 64;

/// Steps leaves [begin, end); begin is a multiple of kLeafBlock. Same bits on every instruction set.
using LeafRange = void (*)(const LeafArrays&, std::uint32_t begin, std::uint32_t end, const LeafStep&);

/// x86-64 levels: 2 (SSE4), 3 (AVX2), 4 (AVX-512); elsewhere there is level 0 only.
int bestLevel();
/// The range function built for a level; nullptr where this machine or build has none.
LeafRange leafRange(int level);

}  // namespace windfall
