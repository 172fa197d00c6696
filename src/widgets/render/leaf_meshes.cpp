#include "widgets/render/leaf_meshes.h"

#include <cstddef>

namespace windfall::render {

namespace {

struct LeafVertexData {
  vec2 place, ribAndLevel, corner;
};

}  // namespace

LeafShape gridShape(const LeafLayer& layer, int columns, int rows) {
  LeafShape shape;
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      const vec2 uv(static_cast<float>(x) / static_cast<float>(columns - 1),
                    1 - static_cast<float>(y) / static_cast<float>(rows - 1));
      LeafCorner corner;
      corner.uv = uv;
      corner.place = {(uv.x - layer.pivot.x) * layer.extent.x, (layer.pivot.y - uv.y) * layer.extent.y};
      corner.rib = corner.place.x;
      shape.corners.push_back(corner);
    }
  }
  for (int y = 0; y + 1 < rows; ++y) {
    for (int x = 0; x + 1 < columns; ++x) {
      const auto at = static_cast<std::uint32_t>(y * columns + x), above = at + static_cast<std::uint32_t>(columns);
      shape.indices.insert(shape.indices.end(), {at, at + 1, above, at + 1, above + 1, above});
    }
  }
  return shape;
}

std::array<LeafShape, kLeafLevels> shapesOf(const LeafLayer& layer) {
  constexpr int kGrids[kLeafLevels][2] = {{3, 5}, {3, 3}, {2, 2}, {2, 2}};
  std::array<LeafShape, kLeafLevels> shapes = layer.levels;
  for (std::size_t level = 0; level < kLeafLevels; ++level) {
    if (shapes[level].indices.empty()) shapes[level] = gridShape(layer, kGrids[level][0], kGrids[level][1]);
  }
  return shapes;
}

void LeafMeshBuffers::upload(const std::vector<LeafLayer>& layers) {
  std::vector<LeafVertexData> vertices;
  std::vector<std::uint32_t> indices;
  commands_.assign(kLeafKinds * layers.size(), {});
  for (std::size_t l = 0; l < layers.size(); ++l) {
    const std::array<LeafShape, kLeafLevels> shapes = shapesOf(layers[l]);
    for (std::size_t level = 0; level < kLeafLevels; ++level) {
      const LeafShape& shape = shapes[level];
      DrawCommand command;
      command.count = static_cast<GLuint>(shape.indices.size());
      command.firstIndex = static_cast<GLuint>(indices.size());
      command.baseVertex = static_cast<GLint>(vertices.size());
      for (const LeafCorner& corner : shape.corners) {
        vertices.push_back({corner.place, {corner.rib, static_cast<float>(level)}, corner.uv});
      }
      indices.insert(indices.end(), shape.indices.begin(), shape.indices.end());
      commands_[level * layers.size() + l] = command;
      if (level >= 2) commands_[(level + 2) * layers.size() + l] = command;
    }
  }
  vertices_ = makeBuffer(static_cast<GLsizeiptr>(vertices.size() * sizeof(LeafVertexData)), vertices.data(), 0);
  indices_ = makeBuffer(static_cast<GLsizeiptr>(indices.size() * sizeof(std::uint32_t)), indices.data(), 0);
  array_ = makeArray();
}

VertexArray LeafMeshBuffers::makeArray() const {
  VertexArray made = makeVertexArray();
  const GLuint array = made.id();
  glVertexArrayVertexBuffer(array, 0, vertices_.id(), 0, sizeof(LeafVertexData));
  glVertexArrayElementBuffer(array, indices_.id());
  const std::size_t offsets[] = {offsetof(LeafVertexData, place), offsetof(LeafVertexData, ribAndLevel),
                                 offsetof(LeafVertexData, corner)};
  for (GLuint location = 0; location < 3; ++location) {
    glEnableVertexArrayAttrib(array, location);
    glVertexArrayAttribFormat(array, location, 2, GL_FLOAT, GL_FALSE, static_cast<GLuint>(offsets[location]));
    glVertexArrayAttribBinding(array, location, 0);
  }
  glEnableVertexArrayAttrib(array, 3);
  glVertexArrayAttribIFormat(array, 3, 1, GL_UNSIGNED_INT, 0);
  glVertexArrayAttribBinding(array, 3, 1);
  glVertexArrayBindingDivisor(array, 1, 1);
  return made;
}

}  // namespace windfall::render
