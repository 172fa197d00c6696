// From rings to the adaptive mesh that the GPU draws (plant_meshing.md, 6.1 and 6.4).
#pragma once

#include <cstdint>
#include <vector>

#include "kernels/detail_data.h"
#include "model/plant/rings.h"

namespace windfall::model {

/// What of a skeleton's segments the adaptive mesh shows and follows; empty vectors: segment i is link i; white wood.
struct DetailSource {
  std::vector<std::int32_t> linkOfSegment;  ///< link that moves a segment; negative: link 0
  std::vector<std::uint32_t> tint;          ///< of a segment, as DetailRing::tint
  bool roots = true;                        ///< shows chains of roots
  float lobes = 0.15f;                      ///< height of the roots round a flaring trunk, share of its radius
};

/// Rings as they are, and for each chain the runs between them at twelve tolerances, each resolution a subset of the
/// finer ones (Douglas and Peucker 1973). Closed tips. Long chains come in pieces of 32 runs, so that a trunk that
/// passes the camera is coarse only where it is far. O(n log n), the same bytes for any number of threads.
DetailMesh makeDetail(const SkeletonGraph& graph, const Chains& chains, const std::vector<ChainCurve>& curves,
                      const RingSet& rings, const DetailSource& source = {});

/// `scale` times as large.
DetailMesh scaled(DetailMesh mesh, float scale);

}  // namespace windfall::model
