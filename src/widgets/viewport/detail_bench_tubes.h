// Static meshes from the same rings as an adaptive mesh, for comparing them.
#pragma once

#include "model/plant/rings.h"
#include "widgets/render/content.h"

namespace windfall::widgets {

/// Corners round a ring and pieces along a run between two rings.
struct TubeCounts {
  std::uint32_t sides = 16, pieces = 8;
};

/// Where a run's surface comes from.
struct TubeSource {
  const std::vector<model::ChainCurve>& curves;
  const model::RingSet& rings;
  const DetailMesh& detail;  ///< made of `rings`, every chain in it
};

/// `across` corners on every ring, `along` pieces on every segment (those of seats and collars share a segment's).
render::Mesh uniformTubes(const TubeSource& source, std::uint32_t across, std::uint32_t along);
/// As many as a deviation of `tolerance` m needs, widened to the outline of a circle (plant_meshing.md, 3).
render::Mesh boundedTubes(const TubeSource& source, float tolerance);

}  // namespace windfall::widgets
