// A way through all links of a tree from its tips to its roots that can rest anywhere and keeps no more than one path.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "sim/tree.h"

namespace windfall::sim {

/// Visits the links of a tree in preorder as a depth-first search that takes children from the last to the first: each
/// link is entered after its parent, and left after everything that it carries. Links are left in falling order. What a
/// visitor needs of the open links stands by their depth, 0 at a root. Memory is taken when it is made.
class BranchWalk {
 public:
  explicit BranchWalk(const std::vector<Link>& links) : entering_(links.empty() ? 0 : depthOf(links)) {
    path_.resize(entering_.size());
    begin(0);
  }

  std::size_t depth() const { return path_.size(); }
  void begin(std::size_t links) {
    next_ = links;
    open_ = waiting_ = 0;
  }
  bool isDone() const { return next_ == 0; }

  /// Goes on for at most `visits` visits, which it takes off; a way takes two a link. The visitor has
  /// `enter(link, depth)` and `leave(link, depth)`.
  template <class Visitor>
  void advance(const std::vector<Link>& links, std::size_t& visits, Visitor& visitor) {
    for (; next_ > 0 && visits > 0; --visits) {
      const std::size_t link = next_ - 1;
      if (waiting_ == 0) {
        for (auto k = static_cast<std::int64_t>(link); k >= 0 && !isOpen(k);
             k = links[static_cast<std::size_t>(k)].parent) {
          entering_[waiting_++] = static_cast<std::uint32_t>(k);
        }
      }
      if (waiting_ > 0) {
        const std::uint32_t entered = entering_[--waiting_];
        path_[open_] = entered;
        visitor.enter(entered, open_++);
      } else {
        visitor.leave(link, --open_);
        next_ = link;
      }
    }
  }

 private:
  bool isOpen(std::int64_t link) const { return open_ > 0 && path_[open_ - 1] == link; }

  static std::size_t depthOf(const std::vector<Link>& links) {
    std::vector<std::uint32_t> depths(links.size());
    std::uint32_t deepest = 0;
    for (std::size_t i = 0; i < links.size(); ++i) {
      depths[i] = links[i].parent < 0 ? 1 : depths[static_cast<std::size_t>(links[i].parent)] + 1;
      deepest = std::max(deepest, depths[i]);
    }
    return deepest;
  }

  std::vector<std::uint32_t> entering_;  ///< links that wait to be entered, the next one last
  std::vector<std::uint32_t> path_;      ///< open links from a root on
  std::size_t next_ = 0;                 ///< links below this index are to be left yet
  std::size_t open_ = 0, waiting_ = 0;
};

}  // namespace windfall::sim
