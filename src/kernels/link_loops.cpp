#include "kernels/link_loops.h"

#include "kernels/link_step.h"
#include "kernels/targets.h"

namespace windfall {

WINDFALL_TARGETS void linkForcesRange(const LinksView& links, const WindView& wind, std::uint32_t begin,
                                      std::uint32_t end) {
  for (std::uint32_t i = begin; i < end; ++i) linkForces(links, wind, i);
}

WINDFALL_TARGETS LinkLoad linkUpRange(const LinksView& links, const LinkStepParameters& step,
                                      std::span<const std::uint32_t> order) {
  for (std::size_t k = order.size(); --k > 0;) {
    addLoad(links.load[links.shape[order[k]].parent], linkUp(links, step, order[k]));
  }
  return linkUp(links, step, order[0]);
}

WINDFALL_TARGETS void linkDownRange(const LinksView& links, const LinkStepParameters& step,
                                    std::span<const std::uint32_t> order) {
  for (const std::uint32_t i : order) linkDown(links, step, i);
}

WINDFALL_TARGETS void linkPoseRange(const LinksView& links, std::uint32_t begin, std::uint32_t end) {
  for (std::uint32_t i = begin; i < end; ++i) linkPose(links, i);
}

}  // namespace windfall
