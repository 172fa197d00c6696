#include "sim/treelets.h"

#include <algorithm>

#include "kernels/link_slots.h"

namespace windfall::sim {

namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

/// Children of each link, in rising order.
struct Children {
  std::vector<std::uint32_t> begin, all;

  explicit Children(std::span<const std::int32_t> parents) : begin(parents.size() + 2, 0), all(parents.size()) {
    // Two places ahead, so that filling leaves the beginnings where they belong.
    for (const std::int32_t p : parents) {
      if (p >= 0) ++begin[static_cast<std::size_t>(p) + 2];
    }
    for (std::size_t i = 2; i < begin.size(); ++i) begin[i] += begin[i - 1];
    for (std::size_t i = 0; i < parents.size(); ++i) {
      if (parents[i] >= 0) all[begin[static_cast<std::size_t>(parents[i]) + 1]++] = static_cast<std::uint32_t>(i);
    }
  }
  std::span<const std::uint32_t> of(std::uint32_t link) const {
    return std::span(all).subspan(begin[link], begin[link + 1] - begin[link]);
  }
};

class Arranger {
 public:
  Arranger(std::span<const std::int32_t> parents, std::uint32_t treelet, std::uint32_t part, std::uint32_t width)
      : parents_(parents),
        width_(std::max(width / kSlotBlock, 1u) * kSlotBlock),
        treelet_(std::max(treelet, 1u)),
        part_(std::max(part, 1u)),
        children_(parents),
        below_(parents.size(), 1),
        height_(parents.size(), 1),
        row_(parents.size(), kNone) {
    for (std::size_t i = parents.size(); i-- > 0;) {
      if (parents[i] < 0) continue;
      const auto p = static_cast<std::size_t>(parents[i]);
      below_[p] += below_[i];
      height_[p] = std::max(height_[p], height_[i] + 1);
    }
    result_.links = static_cast<std::uint32_t>(parents.size());
    result_.slot.resize(parents.size());
  }

  Arrangement run() {
    cut();
    const auto parts = static_cast<std::uint32_t>(groups_.size()) + 1;
    result_.rows = result_.links + 1 + parts;
    result_.sumRows = result_.rows;
    std::vector<std::uint32_t> roots;
    for (const std::uint32_t i : top_) {
      row_[i] = result_.sumRows++;
      if (parents_[i] < 0) roots.push_back(i);
    }
    for (const auto& group : groups_) {
      for (const std::uint32_t root : group) row_[root] = result_.sumRows++;
    }
    place(roots, true);
    for (const auto& group : groups_) place(group, false);
    cross();
    return std::move(result_);
  }

 private:
  bool isTop(std::uint32_t link) const { return below_[link] > treelet_; }

  void cut() {
    std::uint32_t inGroup = part_;
    for (std::uint32_t i = 0; i < result_.links;) {
      if (isTop(i)) {
        top_.push_back(i++);
        continue;
      }
      if (inGroup >= part_) {
        groups_.emplace_back();
        inGroup = 0;
      }
      groups_.back().push_back(i);
      inGroup += below_[i];
      i += below_[i];
    }
  }

  /// Slots of one part, from its roots outward.
  void place(const std::vector<std::uint32_t>& roots, bool top) {
    const std::uint32_t spare = result_.links + 1 + static_cast<std::uint32_t>(result_.parts.size());
    const auto first = static_cast<std::uint32_t>(result_.link.size() / kSlotBlock);
    // A heap of links whose parents are placed: the greatest height first, then the lowest index.
    const auto later = [&](std::uint32_t a, std::uint32_t b) {
      return height_[a] != height_[b] ? height_[a] < height_[b] : a > b;
    };
    std::vector<std::uint32_t> ready(roots), block;
    std::make_heap(ready.begin(), ready.end(), later);
    while (!ready.empty()) {
      block.clear();
      while (!ready.empty() && block.size() < width_) {
        std::pop_heap(ready.begin(), ready.end(), later);
        block.push_back(ready.back());
        ready.pop_back();
      }
      std::sort(block.begin(), block.end());
      for (const std::uint32_t i : block) {
        result_.slot[i] = static_cast<std::uint32_t>(result_.link.size());
        result_.link.push_back(i);
        const std::uint32_t parent = parents_[i] < 0 ? result_.ground() : static_cast<std::uint32_t>(parents_[i]);
        result_.parent.push_back(parent);
        result_.target.push_back(row_[i] != kNone ? row_[i] : parent);
        for (const std::uint32_t child : children_.of(i)) {
          if (top && !isTop(child)) continue;
          ready.push_back(child);
          std::push_heap(ready.begin(), ready.end(), later);
        }
      }
      for (std::size_t k = block.size(); k < width_; ++k) {
        for (auto* rows : {&result_.link, &result_.parent, &result_.target}) rows->push_back(spare);
      }
    }
    result_.parts.push_back({first, static_cast<std::uint32_t>(result_.link.size() / kSlotBlock)});
  }

  /// Sums that wait cross right before the parent's block, children of a link from the last to the first.
  void cross() {
    const Part top = result_.parts.front();
    for (std::uint32_t block = top.begin; block < top.end; ++block) {
      result_.before.push_back(static_cast<std::uint32_t>(result_.crossings.size()));
      for (std::uint32_t lane = 0; lane < kSlotBlock; ++lane) {
        const std::uint32_t link = result_.link[block * kSlotBlock + lane];
        if (link >= result_.links) continue;
        const std::span<const std::uint32_t> children = children_.of(link);
        for (std::size_t c = children.size(); c-- > 0;) result_.crossings.push_back({row_[children[c]], link});
      }
    }
    result_.before.push_back(static_cast<std::uint32_t>(result_.crossings.size()));
    // Sums of roots go nowhere: into the ground.
    for (std::uint32_t i = 0; i < result_.links; i += below_[i]) {
      result_.crossings.push_back({row_[i], result_.ground()});
    }
  }

  std::span<const std::int32_t> parents_;
  std::uint32_t width_, treelet_, part_;
  Children children_;
  std::vector<std::uint32_t> below_, height_, row_;  ///< row_: of the sum that waits, or none
  std::vector<std::uint32_t> top_;
  std::vector<std::vector<std::uint32_t>> groups_;  ///< roots of the treelets of each part
  Arrangement result_;
};

}  // namespace

Arrangement arrange(std::span<const std::int32_t> parents, std::uint32_t treelet, std::uint32_t part,
                    std::uint32_t width) {
  return Arranger(parents, treelet, part, width).run();
}

Gathering gatheringOf(const Arrangement& slots, std::span<const std::int32_t> parents) {
  const Children children(parents);
  Gathering gathering;
  for (std::size_t s = 0; s < slots.link.size(); ++s) {
    gathering.begin.push_back(static_cast<std::uint32_t>(gathering.rows.size()));
    if (slots.link[s] >= slots.links) continue;
    const std::span<const std::uint32_t> own = children.of(slots.link[s]);
    const auto first = static_cast<std::ptrdiff_t>(gathering.rows.size());
    gathering.rows.insert(gathering.rows.end(), own.rbegin(), own.rend());
    // In a treelet the loops add from the last slot to the first, above it from the last link to the first.
    if (s / kSlotBlock < slots.parts.front().end) continue;
    std::sort(gathering.rows.begin() + first, gathering.rows.end(),
              [&](std::uint32_t a, std::uint32_t b) { return slots.slot[a] > slots.slot[b]; });
  }
  gathering.begin.push_back(static_cast<std::uint32_t>(gathering.rows.size()));
  return gathering;
}

}  // namespace windfall::sim
