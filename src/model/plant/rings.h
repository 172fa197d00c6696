// The rings of generalized cylinders: what static meshes and the adaptive mesh on the GPU are made of
// (plant_meshing.md, 2 to 5 and 6.1).
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "model/plant/curves.h"

namespace windfall::model {

struct RingSettings {
  bool collars = true;        ///< pivot seats and collars where chains leave their parents; else bare nodes
  float seat = 0.45f;         ///< radius of a chain's first ring, share of its parent's; at most 0.5
  float collar = 0.25f;       ///< widening K at a collar; 0.1 of green stems is derived from it
  float collarLength = 1.5f;  ///< in radii of the child
  float flare = 0.4f;         ///< widening at a trunk's foot, 0: none; trunks then go on below the ground
  float tipScale = 1;         ///< on the last radius of a chain
  float textureAspect = 1;    ///< height by width of the bark's tile
  float yaw = 0;              ///< of the root's frame, radians
  std::uint64_t seed = 1;     ///< of the phases of bark coordinates
};

/// A cross-section. Rings of a chain are consecutive, from base to tip.
struct Ring {
  vec3 position{0};           ///< m
  float radius = 0;           ///< m, with flare and collar
  vec3 tangent{0, 1, 0};      ///< unit
  float v = 0;                ///< bark coordinate along: integral of ds / (2 pi r aspect)
  vec3 normal{1, 0, 0};       ///< unit, where angle and bark coordinate u are 0
  float along = 0;            ///< arc length from the chain's base, m; negative below the ground
  std::int32_t segment = -1;  ///< that moves it: the one that ends here or passes here; the parent's at a pivot
  std::int32_t own = -1;      ///< segment of its own chain that it lies on
  std::int32_t chain = -1;
  std::int32_t span = 0;  ///< of its chain's curve, that ends or passes here
  float t = 0;            ///< on that span
  float flare = 0;        ///< 0..1: how much of the roots' lobes
  float collar = 0;       ///< 0..1: q of the collar, for occlusion
  float kids = 0;         ///< chains that leave between this ring and the next
};

struct RingChain {
  std::uint32_t first = 0, count = 0;  ///< rings
  float u = 0;                         ///< phase of the bark coordinate around, 0..1
  float exit = 0;                      ///< arc length at which its axis leaves the parent, m; 0 of roots
  float collarLength = 0;              ///< beyond it, m
  float length = 0;                    ///< m
};

struct RingSet {
  std::vector<Ring> rings;
  std::vector<RingChain> chains;  ///< in the order of Chains::chains
};

/// Rings at every joint, at seats and collars, and at a trunk's flare; frames by double reflection from the root up, so
/// that a change near a tip never turns what is below. Parallel over chains of one order; the same bits for any number
/// of threads.
RingSet makeRings(const SkeletonGraph& graph, const Chains& chains, const std::vector<ChainCurve>& curves,
                  const RingSettings& settings = {});

/// Rings of a chain that are kept at a tolerance in m (axis and radius together; Douglas and Peucker 1973; 6.4):
/// positions in the chain, the first and last always among them. A wrong share of the collar counts `collar` m.
std::vector<std::uint32_t> keptRings(const Ring* rings, std::uint32_t count, float tolerance, float collar = 0);

/// The radius between two rings of one span: the curve's own, and what flare, seat and collar make of it at the rings.
class RunningRadius {
 public:
  RunningRadius(const CurveSpan& span, float t0, float t1, float r0, float r1);
  float at(float t) const;
  /// Arc length in m, and arc over radius, between two parameters.
  std::pair<float, float> run(float from, float to) const;

 private:
  const CurveSpan& span_;
  float t0_, t1_, scale0_, scale1_;
};

/// Integral of ds / (2 pi r aspect) over a piece whose radius runs linearly from r0 to r1 (5).
float barkRun(float length, float r0, float r1, float aspect);

}  // namespace windfall::model
