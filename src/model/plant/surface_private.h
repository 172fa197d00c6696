// The steps from rings to triangles.
#pragma once

#include "model/plant/surface.h"

namespace windfall::model {

/// A ring of the final mesh.
struct MeshRing {
  vec3 position{0}, tangent{0, 1, 0}, normal{1, 0, 0};
  float radius = 0;  ///< m
  float slope = 0;   ///< change of the radius along the axis
  float v = 0, along = 0;
  std::uint32_t sides = 3;
  std::uint32_t bones[2]{};
  float second = 0;  ///< weight of bones[1]
  float flare = 0, collar = 0;
  float wood = 1;  ///< 0 green
};

/// What a chain is drawn with: its rings, the dome's among them, and how far its tip stands beyond the last, m.
struct FinalRings {
  std::vector<MeshRing> rings;
  float tip = 0;
};
FinalRings finalRings(const SkeletonGraph& graph, const ChainCurve& curve, const Ring* rings, std::uint32_t count,
                      const RingChain& chain, const MeshSettings& settings);

}  // namespace windfall::model
