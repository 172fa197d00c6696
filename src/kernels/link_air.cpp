#include "kernels/link_air.h"

#include "kernels/targets.h"

namespace windfall {

WINDFALL_TARGETS void linkAir(const LinkSlots<float>& slots, const WindView& wind, std::uint32_t begin,
                              std::uint32_t end, float* air) {
  for (std::uint32_t slot = begin * kSlotBlock; slot < end * kSlotBlock; ++slot) slotAir(slots, wind, slot, air);
}

}  // namespace windfall
