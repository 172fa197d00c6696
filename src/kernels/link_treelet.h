// A subtree swept by a group of threads, level by level: the same on a GPU block and, with one thread, on the CPU.
#pragma once

#include <cstdint>

#include "kernels/link_step.h"

namespace windfall {

/// How a forest is cut for threads that work in groups; pointers of the device that runs it.
struct ForestView {
  const std::uint32_t* order = nullptr;       ///< links of all parts, each part level by level
  const std::uint32_t* levels = nullptr;      ///< where each level of `order` begins; one more at the end
  const std::uint32_t* parts = nullptr;       ///< where each part's levels begin; one more at the end
  const std::uint32_t* children = nullptr;    ///< children of each link, highest index first
  const std::uint32_t* childBegin = nullptr;  ///< where each link's children begin; one more at the end
  LinkLoad* exports = nullptr;                ///< of each link, what goes to its parent
};

/// Upward pass over one part by thread `thread` of `threads`; `wait` lets all threads of the group meet.
/// Parents gather their children from the last to the first, as the loops of the CPU do.
template <class Wait>
WINDFALL_HD void sweepUp(const LinksView& links, const ForestView& forest, const LinkStepParameters& step,
                         std::uint32_t part, std::uint32_t thread, std::uint32_t threads, const Wait& wait) {
  for (std::uint32_t level = forest.parts[part + 1]; level-- > forest.parts[part];) {
    for (std::uint32_t k = forest.levels[level] + thread; k < forest.levels[level + 1]; k += threads) {
      const std::uint32_t i = forest.order[k];
      for (std::uint32_t c = forest.childBegin[i]; c < forest.childBegin[i + 1]; ++c) {
        addLoad(links.load[i], forest.exports[forest.children[c]]);
      }
      forest.exports[i] = linkUp(links, step, i);
    }
    wait();
  }
}

/// Downward pass over one part.
template <class Wait>
WINDFALL_HD void sweepDown(const LinksView& links, const ForestView& forest, const LinkStepParameters& step,
                           std::uint32_t part, std::uint32_t thread, std::uint32_t threads, const Wait& wait) {
  for (std::uint32_t level = forest.parts[part]; level < forest.parts[part + 1]; ++level) {
    for (std::uint32_t k = forest.levels[level] + thread; k < forest.levels[level + 1]; k += threads) {
      linkDown(links, step, forest.order[k]);
    }
    wait();
  }
}

}  // namespace windfall
