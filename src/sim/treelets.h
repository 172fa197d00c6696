// How a forest is cut for threads and packed into the slots of the solvers (tree_dynamics.md, 10, scheme 1).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace windfall::sim {

/// Blocks [begin, end) of slots that one thread takes as a whole.
struct Part {
  std::uint32_t begin = 0, end = 0;
};

/// A sum that goes from a row of its own to the parent's row.
struct Crossing {
  std::uint32_t from = 0, to = 0;
};

/// Slots and rows of a forest; depends on the trees alone, never on the number of threads.
///
/// Part 0 holds the links above all treelets, the others whole subtrees. Inside a part every round of slots holds links
/// that do not wait for each other: parents stand in earlier rounds. The longest way to a tip goes first, which fills
/// the rounds as well as can be (Hu, Parallel sequencing and assembly line problems, 1961).
struct Arrangement {
  std::vector<std::uint32_t> link, parent, target;  ///< rows, of each slot (kernels/link_slots.h)
  std::vector<std::uint32_t> slot;                  ///< of each link
  std::vector<Part> parts;
  /// Blocks of part 0 one by one: those crossings are made before block b goes up; the last entry is their end.
  std::vector<std::uint32_t> before;
  std::vector<Crossing> crossings;
  std::uint32_t links = 0;
  std::uint32_t rows = 0;     ///< links, the ground, and a row a part for slots without a link
  std::uint32_t sumRows = 0;  ///< and one for each sum that waits to cross
  std::uint32_t ground() const { return links; }
};

/// `parents` in preorder over the whole forest. A treelet has at most `treelet` links; a part joins treelets until it
/// has as many as `part`; a round has `width` slots, a multiple of 16.
Arrangement arrange(std::span<const std::int32_t> parents, std::uint32_t treelet, std::uint32_t part,
                    std::uint32_t width);

/// The same for threads that work in groups (kernels/link_sweep.h): children of each slot in the order of their sums.
struct Gathering {
  std::vector<std::uint32_t> begin, rows;
};
Gathering gatheringOf(const Arrangement& slots, std::span<const std::int32_t> parents);

}  // namespace windfall::sim
