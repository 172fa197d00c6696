// The skeleton of one or more plants: what every reader and grower of skeletons makes (plant_meshing.md, 1). SI units,
// Y up.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "kernels/math.h"
#include "sim/result.h"

namespace windfall::model {

enum class SegmentKind : std::uint8_t {
  Stem,
  Petiole,  ///< bears one leaf and nothing else
  Root,
};

/// What a simulator said about an organ: shares 0..1, negative where nothing is known (prim_format.md, versions 4-6).
struct OrganState {
  float water = -1, energy = -1;
  float wood = -1;  ///< 0 green, 1 wood
  /// Version 5: of yesterday and by m2; not limited.
  float irradiance = 0, resources = 0, production = 0, auxins = 0, efficiency = 0;
  bool operator==(const OrganState&) const = default;
};

/// A straight piece of an axis; parents stand before children.
struct Segment {
  vec3 a{0}, b{0};       ///< base and end, m
  float ra = 0, rb = 0;  ///< radii there, m
  float length = 0;      ///< as the source says, m: its axes need not be of unit length; 0: the distance from a to b
  std::int32_t parent = -1;
  std::int32_t organ = -1;   ///< place in its plant's list in the source, -1: none
  std::int32_t bone = -1;    ///< index into PlantGeometry::bones, -1: none
  std::int32_t branch = -1;  ///< a continuous branch that the source names: continues its parent's if both are equal
  float attach = 1;          ///< where on the parent it starts: 0 the parent's a, 1 its b
  SegmentKind kind = SegmentKind::Stem;
  std::int32_t plant = 0;
  OrganState state;
  bool operator==(const Segment&) const = default;
};

struct LeafOrgan {
  std::int32_t segment = -1;  ///< that bears it, -1: stands alone
  std::int32_t plant = 0, organ = -1;
  vec3 base{0}, tip{0};  ///< of the blade, m
  vec3 normal{0, 1, 0};  ///< unit, out of the upper face
  float width = 0;       ///< m
  OrganState state;
  bool operator==(const LeafOrgan&) const = default;
};

struct BudOrgan {
  std::int32_t segment = -1;
  std::int32_t plant = 0, organ = -1;
  vec3 centre{0};
  float radius = 0;  ///< m
  OrganState state;
  bool operator==(const BudOrgan&) const = default;
};

/// Something that stands among the plants and shades them.
struct Obstacle {
  std::vector<vec3> points;              ///< m
  std::vector<std::uint32_t> triangles;  ///< three indices each
  bool operator==(const Obstacle&) const = default;
};

struct SkeletonGraph {
  std::vector<Segment> segments;
  std::vector<LeafOrgan> leaves;
  std::vector<BudOrgan> buds;
  std::vector<Obstacle> obstacles;
  std::int32_t plants = 1;
  bool operator==(const SkeletonGraph&) const = default;
};

/// The length that counts, m.
inline float lengthOf(const Segment& s) { return s.length > 0 ? s.length : glm::length(s.b - s.a); }

/// Puts parents before children, keeping the order otherwise. Errors: loops, parents that are not there, numbers that
/// are no lengths, negative radii, leaves and buds of segments that are not there; each names plant and organ.
Result<SkeletonGraph> sortedGraph(SkeletonGraph graph);

/// Marks as petioles the stems whose only child is one leaf; sets `attach` by projection on the parent.
void finishGraph(SkeletonGraph& graph);

/// Without segments that are too short to matter: below 0.1 mm or a tenth of their radius (plant_meshing.md, 1,
/// "Degenerate"). Their children, leaves and buds go to their parent; runs of them add up. Roots stay.
/// `kept`, if given, maps each segment of `graph` to its place in the result: its own, or that of what took its
/// children.
SkeletonGraph withoutStubs(const SkeletonGraph& graph, std::vector<std::int32_t>* kept = nullptr);

/// `scale` times as large.
SkeletonGraph scaled(SkeletonGraph graph, double scale);

}  // namespace windfall::model
