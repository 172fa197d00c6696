// Smooth curves through the segments of a chain (plant_meshing.md, 2.1).
#pragma once

#include <cstdint>
#include <vector>

#include "model/plant/chains.h"
#include "model/plant/skeleton_graph.h"

namespace windfall::model {

enum class CurveKind {
  Hermite,  ///< through the joints, C1, centripetal steps
  BSpline,  ///< uniform cubic, C2, near the joints: for dense skeletons
};

/// A cubic piece with its radius; `share0` to `share1` of a segment.
struct CurveSpan {
  vec3 p0{0}, p1{0};                     ///< m
  vec3 m0{0}, m1{0};                     ///< derivatives by the parameter 0..1
  float r0 = 0, r1 = 0, d0 = 0, d1 = 0;  ///< radius and its derivatives by the parameter, m
  std::int32_t segment = -1;
  float share0 = 0, share1 = 1;

  vec3 point(float t) const;
  /// Unit; the chord's direction where the derivative vanishes.
  vec3 tangent(float t) const;
  vec3 derivative(float t) const;
  float radius(float t) const;
  /// Arc length from 0 to t, m (Gauss-Legendre, five points).
  float length(float t) const;
};

/// Where a chain leaves its parent.
struct Pivot {
  vec3 point{0};           ///< on the parent's curve; a root's own base
  vec3 tangent{0, 1, 0};   ///< of the parent there, unit
  float radius = 0;        ///< of the parent there, m
  std::int32_t span = -1;  ///< of the parent's, index into ChainCurve::spans
  float t = 0;
};

struct ChainCurve {
  std::vector<CurveSpan> spans;
  Pivot pivot;
};

/// The curves of all chains, in their order. Parallel over chains of one order; the same bits for any number of
/// threads.
std::vector<ChainCurve> makeCurves(const SkeletonGraph& graph, const Chains& chains, CurveKind kind);

/// Slopes of a monotone cubic through values r over steps h (Fritsch and Carlson 1980, harmonic mean).
std::vector<float> monotoneSlopes(const std::vector<float>& r, const std::vector<float>& h);

}  // namespace windfall::model
