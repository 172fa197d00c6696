// Connected pieces of a mesh.
#pragma once

#include <cstdint>
#include <vector>

#include "model/plant/geometry.h"

namespace windfall::model {

/// The connected piece of every triangle of a part, numbered by first appearance. Vertices at one place are one, even
/// where they were split for their normals or texture coordinates.
struct MeshPieces {
  std::vector<std::uint32_t> ofTriangle;
  std::uint32_t count = 0;
};
MeshPieces connectedPieces(const PlantGeometry& geometry, const MeshPart& part);

}  // namespace windfall::model
