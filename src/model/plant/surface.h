// Rings to triangles: generalized cylinders with counts by an error bound (plant_meshing.md, 3, 4, 5, 7).
#pragma once

#include "model/plant/geometry.h"
#include "model/plant/rings.h"

namespace windfall::model {

struct MeshSettings {
  float tolerance = 5e-4f;   ///< deviation of the mesh from the surface, m
  bool merge = true;         ///< leaves out rings that the tolerance does not need
  bool widthFactor = true;   ///< widens rings of few sides to the outline of a circle (3.3)
  bool evenBark = true;      ///< splits where the radius changes, so that bark is stretched by less than 10 %
  float barkFrom = 0;        ///< m; stems thinner than this show no picture that could be stretched
  bool seats = true;         ///< follows a curve closely where chains leave it, so that their seats stay inside
  bool dome = true;          ///< rounded tips; else a vertex alone
  bool capBases = true;      ///< closes each chain where it starts, inside its parent or under the ground
  bool blendNormals = true;  ///< towards the parent's at junctions
  float lobes = 5;           ///< roots round a flaring trunk
  float gnarl = 0;           ///< bumps, share of the radius
  float tile = 0.15f;        ///< width of the bark's tile, m; a third of it on green stems
  bool bakeRepeats = false;  ///< texture coordinates that need no shader: whole repeats a chain
  std::uint64_t seed = 1;
};

struct SurfaceMesh {
  std::vector<Vertex> vertices;           ///< `bones` are segments of the graph
  std::vector<std::uint32_t> indices;     ///< chain by chain, counter-clockwise seen from outside
  std::vector<std::uint32_t> firstIndex;  ///< of each chain, and the end
};

/// Sides of a ring of radius `r` at a tolerance, both in m (3.1).
std::uint32_t ringSides(float radius, float tolerance);
/// Factor by which a polygon of so many sides is widened (3.3).
float widthFactor(float sides);

/// The surface of all chains. Parallel over chains, written in place after counting: the same bytes for any number of
/// threads.
SurfaceMesh meshRings(const SkeletonGraph& graph, const Chains& chains, const std::vector<ChainCurve>& curves,
                      const RingSet& rings, const MeshSettings& settings);

/// "--detail": 4 mm at 0 to 0.05 mm at 1 (7).
float toleranceOf(double detail);

}  // namespace windfall::model
