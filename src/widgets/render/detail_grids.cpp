#include "widgets/render/detail_grids.h"

namespace windfall::render {

DetailGrids makeDetailGrids() {
  DetailGrids out;
  for (std::uint32_t level = 0; level < kDetailRadial; ++level) {
    for (std::uint32_t axial = 0; axial < kDetailAxial; ++axial) {
      const std::uint32_t sides = 3u << level, pieces = 1u << axial, columns = level == 0 ? sides : sides + 1;
      GridCommand& command = out.commands[level * kDetailAxial + axial];
      command.firstIndex = static_cast<std::uint32_t>(out.indices.size());
      command.baseVertex = static_cast<std::uint32_t>(out.vertices.size());
      for (std::uint32_t i = 0; i <= pieces; ++i) {
        for (std::uint32_t j = 0; j < columns; ++j) {
          out.vertices.push_back({static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(j),
                                  static_cast<std::uint8_t>(pieces), static_cast<std::uint8_t>(level)});
        }
      }
      for (std::uint32_t i = 0; i < pieces; ++i) {
        for (std::uint32_t j = 0; j < sides; ++j) {
          const std::uint32_t next = (j + 1) % columns, a = i * columns, b = a + columns;
          for (const std::uint32_t index : {a + j, a + next, b + j, a + next, b + next, b + j}) {
            out.indices.push_back(static_cast<std::uint16_t>(index));
          }
        }
      }
      command.count = static_cast<std::uint32_t>(out.indices.size()) - command.firstIndex;
      out.vertexCount[level * kDetailAxial + axial] = (pieces + 1) * columns;
    }
  }
  return out;
}

}  // namespace windfall::render
