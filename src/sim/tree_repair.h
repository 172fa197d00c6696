// Trees from elsewhere made fit for the simulation: what is wrong is mended, and told.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/tree.h"

namespace windfall::sim {

/// What was mended.
struct TreeRepair {
  /// One line a kind of fault: "3 links have no length and become stubs, the first is link 7"; empty: nothing was
  /// wrong.
  std::vector<std::string> notes;
  /// Of each link of the mended tree its index in the given one.
  std::vector<std::int32_t> from;
  bool reordered = false;  ///< links stand in another order than before

  bool any() const { return !notes.empty(); }
};

/// Mends a tree in place so that problemOf() finds nothing, whatever it holds; a tree without a fault is left as it is.
///
/// Parents that are not there make a link a root; a loop of parents is cut at its first link; links are put in the
/// order that Tree asks for, side axes behind their parents as they stood. A link without length becomes a stub that
/// ends where its child begins, one without thickness takes part of its parent's, giants are cut to what problemOf()
/// takes; other numbers that are none, or beyond all measure, become the parent's or the default. Leaves that hang on
/// no link are dropped.
TreeRepair repairTree(Tree& tree);

}  // namespace windfall::sim
