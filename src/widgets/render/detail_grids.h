// The twenty prebuilt ring grids of the adaptive mesh (plant_meshing.md, 6.3).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "kernels/detail_select.h"

namespace windfall::render {

/// A command of glMultiDrawElementsIndirect.
struct GridCommand {
  std::uint32_t count = 0, instances = 0, firstIndex = 0, baseVertex = 0, baseInstance = 0;
};
static_assert(sizeof(GridCommand) == 20);

/// Place along, place around, pieces, level of the sides.
struct GridVertex {
  std::uint8_t along = 0, around = 0, pieces = 1, level = 0;
};

/// Grid 4 k + a has 3 * 2^k sides and 2^a pieces. The grids of three sides have no seam: they are too thin to show one.
struct DetailGrids {
  std::vector<GridVertex> vertices;
  std::vector<std::uint16_t> indices;
  std::array<GridCommand, kDetailGrids> commands;         ///< without instances
  std::array<std::uint32_t, kDetailGrids> vertexCount{};  ///< of an instance
};

DetailGrids makeDetailGrids();

}  // namespace windfall::render
