// The memory of a field of leaves: one array a quantity, the same on host and device.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernels/leaf_instance.h"
#include "kernels/leaf_motion.h"
#include "kernels/link_state.h"
#include "kernels/math.h"
#include "kernels/wind.h"

namespace windfall {

/// `LeafArrays::link` of a leaf that never hung on a tree.
inline constexpr std::uint32_t kLoose = 0xffffffffu;

/// Totals that leaves add to as they change state; integers, so that no order of threads shows.
struct LeafTotals {
  std::int32_t attached, airborne, grounded, spare;
  std::int64_t landed, fallMicroseconds;
};

/// Bits of LeafArrays::meta.
inline constexpr std::uint32_t kStateMask = 7u;        ///< LeafState
inline constexpr std::uint32_t kMotionShift = 3u;      ///< LeafMotion, 3 bits
inline constexpr std::uint32_t kFaceBit = 1u << 6u;    ///< the upper face is below
inline constexpr std::uint32_t kMirrorBit = 1u << 7u;  ///< chirality -1
inline constexpr std::uint32_t kFreshBit = 1u << 8u;   ///< the first stage since the leaf came loose
inline constexpr std::uint32_t kGustBit = 1u << 9u;    ///< a gust ends the stage
inline constexpr std::uint32_t kStageShift = 10u;      ///< number of the stage, 16 bits

WINDFALL_HD LeafState stateOf(std::uint32_t meta) { return static_cast<LeafState>(meta & kStateMask); }
WINDFALL_HD std::uint32_t motionOf(std::uint32_t meta) { return (meta >> kMotionShift) & 7u; }

/// Pointers into one block. Lengths: `count`, but `lost` one a link and `totals` one. SI units, world axes where no
/// frame is named.
struct LeafArrays {
  std::uint32_t count;
  // Fixed with the scene.
  std::uint32_t* link;           ///< or kLoose
  vec4* siteTurn;                ///< leaf frame to link frame
  float *siteX, *siteY, *siteZ;  ///< petiole's end, link frame
  float* size;                   ///< blade length
  float* toughness;              ///< strength of the petiole over the season's
  std::uint32_t* layer;
  // Follow from seed, index, generation and, for the speed, the leaf's mass when it was drawn.
  float *speed, *flutter, *headingX, *headingZ;
  // State. `x` to `turn` are what the last step left; the step writes `next...`, then both change places, so that
  // between steps `next...` is the state before the last one. A resting leaf has equal values in both; unused while
  // attached.
  float *x, *y, *z;     ///< middle of the blade
  std::uint32_t* turn;  ///< packed, leaf frame to world
  float *nextX, *nextY, *nextZ;
  std::uint32_t* nextTurn;
  float *driftX, *driftY,
      *driftZ;                   ///< falling: the wind's part of the velocity; sliding: velocity; attached: wind felt
  float *windX, *windY, *windZ;  ///< air velocity where the leaf is, refreshed now and then
  float* clock;                  ///< s since the stage, the slide or the growth began
  float* length;                 ///< s, of the stage; resting: time at which the leaf is gone
  float* phase;                  ///< s, added to the clock
  float* yaw;                    ///< turns, at the start of the stage
  float *offsetX, *offsetY, *offsetZ;  ///< m/s, what the last stage's velocity was beyond this one's at the change
  std::uint32_t* offsetTurn;           ///< the same of the turn, packed
  float* born;                         ///< time of release, s
  std::uint32_t* meta;
  std::uint32_t* generation;
  std::int32_t* lost;  ///< a link: leaves lost less leaves grown again
  LeafTotals* totals;
};

/// Calls visit(pointer, elements, isState) for each array, in the order in which they lie in the block.
template <class Visit>
void visitArrays(LeafArrays& a, std::uint32_t links, Visit&& visit) {
  const std::uint32_t n = a.count;
  visit(a.link, n, false), visit(a.siteTurn, n, false), visit(a.siteX, n, false), visit(a.siteY, n, false);
  visit(a.siteZ, n, false), visit(a.size, n, false), visit(a.toughness, n, false), visit(a.layer, n, false);
  visit(a.speed, n, true), visit(a.flutter, n, true), visit(a.headingX, n, true), visit(a.headingZ, n, true);
  visit(a.x, n, true), visit(a.y, n, true), visit(a.z, n, true), visit(a.turn, n, true);
  visit(a.nextX, n, true), visit(a.nextY, n, true), visit(a.nextZ, n, true), visit(a.nextTurn, n, true);
  visit(a.driftX, n, true), visit(a.driftY, n, true), visit(a.driftZ, n, true);
  visit(a.windX, n, true), visit(a.windY, n, true), visit(a.windZ, n, true);
  visit(a.clock, n, true), visit(a.length, n, true), visit(a.phase, n, true), visit(a.yaw, n, true);
  visit(a.offsetX, n, true), visit(a.offsetY, n, true), visit(a.offsetZ, n, true), visit(a.offsetTurn, n, true);
  visit(a.born, n, true), visit(a.meta, n, true), visit(a.generation, n, true);
  visit(a.lost, links, true), visit(a.totals, 1u, true);
}

/// What is the same for all leaves in a step.
struct LeafStep {
  std::uint64_t seed = 1;
  std::uint32_t number = 0;                ///< of the step
  std::uint32_t interval = 4;              ///< steps between two looks at the wind and at the petiole
  float time = 0, dt = 1.f / 60;           ///< s, start and length
  float flutterClock = 0;                  ///< time modulo kFlutterPeriod
  float feltDecay = 1;                     ///< of the difference between felt and real wind in a step, attached leaves
  float strength = 1;                      ///< N, median petiole of the season
  float speed = 1.15f;                     ///< m/s, median terminal speed
  float spawnHeight = 0, spawnRadius = 0;  ///< m, of loose leaves
  vec3 spawnCentre{0};
  bool respawn = false;
  LinkView links;
  WindView wind;
};

/// All flutter is periodic in this many seconds.
inline constexpr float kFlutterPeriod = 64;

WINDFALL_HD LeafTraits traitsOf(const LeafArrays& a, std::size_t i, std::uint32_t meta) {
  return {a.speed[i], a.flutter[i], a.headingX[i], a.headingZ[i], (meta & kMirrorBit) != 0 ? -1.0f : 1.0f};
}

}  // namespace windfall
