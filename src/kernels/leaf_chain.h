// The order in which motions follow each other: a Markov chain in exact integers (falling_leaves.md, 5.1).
#pragma once

#include <cstdint>

#include "kernels/leaf_motion.h"

namespace windfall {

/// Counts of transitions from a motion to the six; the row's sum is its denominator.
struct ChainRow {
  std::uint32_t count[kLeafMotions];
};

WINDFALL_HD ChainRow chainRow(std::uint32_t motion) {
  switch (motion) {
    case kSteady:
      return {{4, 9, 1, 1, 8, 3}};
    case kTumbling:
      return {{0, 15, 1, 4, 14, 12}};
    case kChaotic:
      return {{0, 0, 16, 3, 9, 8}};
    case kFluttering:
      return {{0, 0, 0, 16, 2, 5}};
    case kHelical:
      return {{0, 0, 0, 0, 12, 1}};
    default:
      return {{0, 0, 0, 0, 0, 1}};
  }
}

/// Walks a row with a random 32-bit number; never past the row.
WINDFALL_HD std::uint32_t drawFrom(const ChainRow& row, std::uint32_t random) {
  std::uint32_t total = 0;
  for (const std::uint32_t count : row.count) total += count;
  auto rest = static_cast<std::uint32_t>((static_cast<std::uint64_t>(random) * total) >> 32u);
  std::uint32_t motion = 0;
  while (motion + 1 < kLeafMotions && rest >= row.count[motion]) rest -= row.count[motion++];
  return motion;
}

WINDFALL_HD std::uint32_t nextMotion(std::uint32_t motion, std::uint32_t random) {
  return drawFrom(chainRow(motion), random);
}

/// The first stage, by the weights of the rows (5.2).
WINDFALL_HD std::uint32_t firstMotion(std::uint32_t random) { return drawFrom({{26, 46, 36, 23, 13, 0}}, random); }

}  // namespace windfall
