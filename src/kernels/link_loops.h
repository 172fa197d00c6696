// The loops of the tree solver over ranges of links on the CPU, for the best instruction set of the machine.
#pragma once

#include <cstdint>
#include <span>

#include "kernels/link_data.h"
#include "kernels/wind.h"

namespace windfall {

/// Own loads of links begin..end.
void linkForcesRange(const LinksView& links, const WindView& wind, std::uint32_t begin, std::uint32_t end);
/// Upward pass over a whole subtree, given level by level from its root; what the root hands to its parent.
LinkLoad linkUpRange(const LinksView& links, const LinkStepParameters& step, std::span<const std::uint32_t> order);
/// Downward pass over links whose parents come before them or are done.
void linkDownRange(const LinksView& links, const LinkStepParameters& step, std::span<const std::uint32_t> order);
/// Poses links begin..end without moving them.
void linkPoseRange(const LinksView& links, std::uint32_t begin, std::uint32_t end);

}  // namespace windfall
