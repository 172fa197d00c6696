// The air's velocity at the middle of every link: what the solvers' loads are made of.
#pragma once

#include <cstdint>

#include "kernels/link_slots.h"
#include "kernels/wind_lookup.h"

namespace windfall {

/// Samples the wind at one slot's link, in the pose of slots.before, into blocks of 3 fields.
WINDFALL_HD void slotAir(const LinkSlots<float>& slots, const WindView& wind, std::uint32_t slot, float* air) {
  const float* row = slots.before + std::size_t{slots.link[slot]} * kRow;
  const float half = fieldsOf(slots.constants, slots.constantFields, slot).get(kHalf);
  const vec4 turn(row[0], row[1], row[2], row[3]);
  const vec3 place(row[kPosePlace], row[kPosePlace + 1], row[kPosePlace + 2]);
  const vec3 u = airAt(wind, place + rotate(turn, vec3(0, 0, half)));
  const SlotFields<float> out = fieldsOf(air, 3, slot);
  out.put(0, u.x);
  out.put(1, u.y);
  out.put(2, u.z);
}

/// Samples the wind at the links of blocks [begin, end).
void linkAir(const LinkSlots<float>& slots, const WindView& wind, std::uint32_t begin, std::uint32_t end, float* air);

}  // namespace windfall
