// The air's velocity at the middle of a link: what the solvers' loads are made of.
#pragma once

#include <cstdint>

#include "kernels/link_algebra.h"
#include "kernels/link_slots.h"
#include "kernels/wind_lookup.h"

namespace windfall {

/// Samples the wind at one slot's link, in the pose of slots.before, into blocks of 3 fields.
WINDFALL_HD void slotAir(const LinkSlots<float>& slots, const WindView& wind, std::uint32_t slot, float* air) {
  const float* row = slots.before + std::size_t{slots.link[slot]} * kRow;
  const float half = fieldsOf(slots.constants, slots.constantFields, slot).get(kHalf);
  const V3<float> joint{row[kPosePlace], row[kPosePlace + 1], row[kPosePlace + 2]};
  const V3<float> middle = joint + alongOf(Turn<float>{row[0], row[1], row[2], row[3]}) * half;
  const vec3 u = airAt(wind, vec3(middle.x, middle.y, middle.z));
  const SlotFields<float> out = fieldsOf(air, 3, slot);
  out.put(0, u.x);
  out.put(1, u.y);
  out.put(2, u.z);
}

}  // namespace windfall
