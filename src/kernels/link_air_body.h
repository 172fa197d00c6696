// The air at many links at once: where each stands is reckoned in lanes, the nodes are read link by link. Only for
// link_loops_body.h. The same bits as slotAir().
#pragma once

#include "kernels/link_air.h"
#include "kernels/link_lanes.h"

namespace windfall {
inline namespace WINDFALL_LANES {

WINDFALL_INLINE LaneInts wholeOf(const Lanes& a) { return __builtin_convertvector(a.v, LaneInts); }
WINDFALL_INLINE Lanes realOf(const LaneInts& a) { return Lanes(__builtin_convertvector(a, LaneFloats)); }

/// Of one coordinate: the cell's number, and where in it a place lies.
struct LaneCell {
  LaneInts whole;
  Lanes part;
};
/// Cells of a lattice that ends; not a number is at 0.
WINDFALL_INLINE LaneCell cellWithin(const Lanes& at, int count) {
  const Lanes last(static_cast<float>(count - 1)), above = select(at > Lanes(0.0f), at, Lanes(0.0f));
  const Lanes inside = select(above < last, above, last);
  const LaneInts whole = wholeOf(inside);
  return {whole, inside - realOf(whole)};
}
/// Cells of a tile that repeats; not a number, and what is too far, is at 0.
WINDFALL_INLINE LaneCell cellOfTile(const Lanes& at) {
  const LaneInts near = ((at > Lanes(-1e6f)).v & (at < Lanes(1e6f)).v);
  const Lanes sane = select(LaneMask{near}, at, Lanes(0.0f));
  const LaneInts towardsZero = wholeOf(sane);
  const LaneInts whole = towardsZero + (sane < realOf(towardsZero)).v;  // a mask is -1 where it holds
  return {whole, sane - realOf(whole)};
}

/// The cells of as many places as there are lanes, lane by lane.
struct LaneCells {
  alignas(64) std::int32_t x0[kNativeLanes], x1[kNativeLanes], y0[kNativeLanes], y1[kNativeLanes], z0[kNativeLanes],
      z1[kNativeLanes];
  alignas(64) float fx[kNativeLanes], fy[kNativeLanes], fz[kNativeLanes];

  WINDFALL_INLINE static void put(std::int32_t* to, const LaneInts& ints) { __builtin_memcpy(to, &ints, sizeof ints); }
  WINDFALL_INLINE CellPlace at(int lane) const {
    return {x0[lane], x1[lane], y0[lane], y1[lane], z0[lane], z1[lane], fx[lane], fy[lane], fz[lane]};
  }
};

WINDFALL_INLINE void findInLattice(const WindView& wind, const V3<Lanes>& place, LaneCells& cells) {
  const LaneCell x = cellWithin((place.x - Lanes(wind.origin.x)) * Lanes(wind.perMetre.x), wind.nx);
  const LaneCell y = cellWithin((place.y - Lanes(wind.origin.y)) * Lanes(wind.perMetre.y), wind.ny);
  const LaneCell z = cellWithin((place.z - Lanes(wind.origin.z)) * Lanes(wind.perMetre.z), wind.nz);
  const int slice = wind.nx * wind.ny;
  const LaneInts first = (z.whole * wind.ny + y.whole) * wind.nx + x.whole;
  LaneCells::put(cells.x0, first);
  LaneCells::put(cells.x1, first - (x.whole < wind.nx - 1));
  LaneCells::put(cells.y0, LaneInts{});
  LaneCells::put(cells.y1, (y.whole < wind.ny - 1) & wind.nx);
  LaneCells::put(cells.z0, LaneInts{});
  LaneCells::put(cells.z1, (z.whole < wind.nz - 1) & slice);
  x.part.store(cells.fx);
  y.part.store(cells.fy);
  z.part.store(cells.fz);
}

WINDFALL_INLINE void findInTile(const V3<Lanes>& place, LaneCells& cells) {
  constexpr int kSlice = kTileX * kTileY;
  const LaneCell x = cellOfTile(place.x), y = cellOfTile(place.y), z = cellOfTile(place.z);
  const LaneInts x0 = x.whole & (kTileX - 1), y0 = (y.whole & (kTileY - 1)) * kTileX;
  const LaneInts z0 = (z.whole & (kTileZ - 1)) * kSlice;
  LaneCells::put(cells.x0, x0);
  LaneCells::put(cells.x1, (x0 + 1) & (kTileX - 1));
  LaneCells::put(cells.y0, y0);
  LaneCells::put(cells.y1, (y0 + kTileX) & (kSlice - 1));
  LaneCells::put(cells.z0, z0);
  LaneCells::put(cells.z1, (z0 + kSlice) & (kTileZ * kSlice - 1));
  x.part.store(cells.fx);
  y.part.store(cells.fy);
  z.part.store(cells.fz);
}

/// airAt() of as many places as there are lanes.
WINDFALL_INLINE V3<Lanes> airAtLanes(const WindView& wind, const V3<Lanes>& place) {
  const Lanes none(0.0f);
  if (wind.velocity == nullptr) return {none, none, none};
  // A node and an eddy of each lane.
  alignas(64) float values[kNativeLanes * 8];
  LaneCells cells;
  std::uint32_t index[kNativeLanes];
  findInLattice(wind, place, cells);
  for (int lane = 0; lane < kNativeLanes; ++lane) {
    index[lane] = static_cast<std::uint32_t>(lane);
    const vec4 node = trilinear(wind.velocity, cells.at(lane));
    __builtin_memcpy(values + 8 * lane, &node, sizeof node);
  }
  const bool eddies = wind.eddies != nullptr;
  if (eddies) {
    const Lanes scale(wind.eddiesPerMetre);
    findInTile({place.x * scale - Lanes(wind.eddyScroll.x), place.y * scale - Lanes(wind.eddyScroll.y),
                place.z * scale - Lanes(wind.eddyScroll.z)},
               cells);
  }
  for (int lane = 0; lane < kNativeLanes; ++lane) {
    const vec4 eddy = eddies ? trilinear(wind.eddies, cells.at(lane)) : vec4(0);
    __builtin_memcpy(values + 8 * lane + 4, &eddy, sizeof eddy);
  }
  Rows<8> rows;
  rows.read<false>(static_cast<const float*>(values), index);
  V3<Lanes> velocity{rows.field[0], rows.field[1], rows.field[2]};
  if (eddies) {
    const Lanes size = rows.field[3], height = select(place.y > none, place.y, none);
    const Lanes rise = Lanes(0.6f) * height / (height + Lanes(1.0f)) * rows.field[5];
    const LaneMask blown = size > none;
    velocity.x = select(blown, velocity.x + size * rows.field[4], velocity.x);
    velocity.y = select(blown, velocity.y + size * rise, velocity.y);
    velocity.z = select(blown, velocity.z + size * rows.field[6], velocity.z);
  }
  if (wind.fanCount == 0) return velocity;
  for (int lane = 0; lane < kNativeLanes; ++lane) {
    const vec3 at(place.x.v[lane], place.y.v[lane], place.z.v[lane]);
    for (int i = 0; i < wind.fanCount; ++i) {
      const vec3 jet = jetAt(wind.fans[i], wind.eddies, wind.eddiesPerMetre, at);
      velocity.x.v[lane] += jet.x;
      velocity.y.v[lane] += jet.y;
      velocity.z.v[lane] += jet.z;
    }
  }
  return velocity;
}

inline void airPass(const LinkSlots<float>& slots, const WindView& wind, std::uint32_t begin, std::uint32_t end,
                    float* air) {
  for (std::uint32_t first = begin * kSlotBlock; first < end * kSlotBlock; first += kNativeLanes) {
    const std::size_t block = first / kSlotBlock, lane = first % kSlotBlock;
    const LaneConstants constant{slots.constants + block * slots.constantFields * kSlotBlock + lane};
    Rows<kRow> rows;
    rows.read<false>(slots.before, slots.link + first);
    const Turn<Lanes> turn{rows.field[0], rows.field[1], rows.field[2], rows.field[3]};
    const V3<Lanes> joint{rows.field[kPosePlace], rows.field[kPosePlace + 1], rows.field[kPosePlace + 2]};
    putVector(LaneFields{air + block * 3 * kSlotBlock + lane}, 0,
              airAtLanes(wind, joint + alongOf(turn) * constant.get(kHalf)));
  }
}

}  // namespace WINDFALL_LANES
}  // namespace windfall
