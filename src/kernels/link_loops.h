// The loops of the tree solver over ranges of links on the CPU, for the best instruction set of the machine.
#pragma once

#include <cstdint>

#include "kernels/link_data.h"
#include "kernels/wind.h"

namespace windfall {

/// Own loads of links begin..end.
void linkForcesRange(const LinksView& links, const WindView& wind, std::uint32_t begin, std::uint32_t end);
/// Upward pass over a whole subtree begin..end; what its root hands to its parent.
LinkLoad linkUpRange(const LinksView& links, const LinkStepParameters& step, std::uint32_t begin, std::uint32_t end);
/// Downward pass over links begin..end, whose outer parents are done.
void linkDownRange(const LinksView& links, const LinkStepParameters& step, std::uint32_t begin, std::uint32_t end);
/// Poses links begin..end without moving them.
void linkPoseRange(const LinksView& links, std::uint32_t begin, std::uint32_t end);

}  // namespace windfall
