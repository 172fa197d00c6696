#include "widgets/render/leaf_pass.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include <glm/gtc/type_ptr.hpp>

#include "kernels/leaf_instance.h"
#include "widgets/render/mip_chain.h"
#include "widgets/render/shader_program.h"

namespace windfall::render {

namespace {

constexpr std::size_t kArrayBytes = std::size_t{256} << 20;  // of the texture array, without its mip levels

/// Side of the array's layers: the largest picture's, a power of two, within the memory.
int layerSize(const std::vector<LeafLayer>& layers) {
  int wanted = 1, size = 16;
  for (const LeafLayer& layer : layers) wanted = std::max({wanted, layer.picture.width, layer.picture.height});
  while (size < std::min(wanted, 1024)) size *= 2;
  while (size > 64 && static_cast<std::size_t>(size) * static_cast<std::size_t>(size) * 4 * layers.size() > kArrayBytes)
    size /= 2;
  return size;
}

}  // namespace

Status LeafPass::compile() {
  for (auto [program, vertex, fragment, define] :
       {std::tuple{&standard_, "leaf.vert", "leaf.frag", "STANDARD_QUALITY"},
        std::tuple{&high_, "leaf.vert", "leaf.frag", "HIGH_QUALITY"},
        std::tuple{&shadowProgram_, "leaf_shadow.vert", "leaf_shadow.frag", "STANDARD_QUALITY"}}) {
    Result<Program> linked = linkProgram(vertex, fragment, {define});
    if (!linked) return linked.error();
    *program = std::move(*linked);
  }
  return ok();
}

LeafPass::Grid LeafPass::makeGrid(int columns, int rows) {
  std::vector<vec2> points;
  std::vector<std::uint16_t> indices;
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      points.emplace_back(static_cast<float>(2 * x) / static_cast<float>(columns - 1) - 1,
                          static_cast<float>(y) / static_cast<float>(rows - 1));
    }
  }
  for (int y = 0; y + 1 < rows; ++y) {
    for (int x = 0; x + 1 < columns; ++x) {
      const int corner = y * columns + x;
      for (const int index :
           {corner, corner + 1, corner + columns, corner + 1, corner + columns + 1, corner + columns}) {
        indices.push_back(static_cast<std::uint16_t>(index));
      }
    }
  }
  Grid grid;
  grid.indexCount = static_cast<GLsizei>(indices.size());
  grid.vertices = makeBuffer(static_cast<GLsizeiptr>(points.size() * sizeof(vec2)), points.data(), 0);
  grid.indices = makeBuffer(static_cast<GLsizeiptr>(indices.size() * sizeof(std::uint16_t)), indices.data(), 0);
  grid.array = makeVertexArray();
  const GLuint array = grid.array.id();
  glVertexArrayVertexBuffer(array, 0, grid.vertices.id(), 0, sizeof(vec2));
  glVertexArrayElementBuffer(array, grid.indices.id());
  glVertexArrayBindingDivisor(array, 1, 1);
  for (GLuint location = 0; location < 5; ++location) glEnableVertexArrayAttrib(array, location);
  glVertexArrayAttribFormat(array, 0, 2, GL_FLOAT, GL_FALSE, 0);
  glVertexArrayAttribBinding(array, 0, 0);
  glVertexArrayAttribFormat(array, 1, 4, GL_FLOAT, GL_FALSE, offsetof(LeafInstance, position));
  glVertexArrayAttribFormat(array, 2, 4, GL_FLOAT, GL_FALSE, offsetof(LeafInstance, rotation));
  glVertexArrayAttribIFormat(array, 3, 2, GL_UNSIGNED_INT, offsetof(LeafInstance, layer));
  glVertexArrayAttribFormat(array, 4, 2, GL_FLOAT, GL_FALSE, offsetof(LeafInstance, curl));
  for (GLuint location = 1; location < 5; ++location) glVertexArrayAttribBinding(array, location, 1);
  return grid;
}

Status LeafPass::setContent(const SceneContent& content) {
  maps_.reset();
  layers_.reset();
  if (content.leafLayers.empty()) {
    if (content.leafCount == 0) return ok();
    return Error{"leaves without a leaf texture"};
  }
  GLint most = 0;
  glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &most);
  if (content.leafLayers.size() > static_cast<std::size_t>(most)) {
    return Error{std::to_string(content.leafLayers.size()) + " leaf textures; this graphics device takes " +
                 std::to_string(most)};
  }
  for (const LeafLayer& layer : content.leafLayers) {
    const Picture& p = layer.picture;
    if (p.width < 1 || p.height < 1 ||
        p.rgba.size() != static_cast<std::size_t>(p.width) * static_cast<std::size_t>(p.height) * 4) {
      return Error{"a leaf texture is empty or its size is wrong"};
    }
  }
  clearErrors();
  const int size = layerSize(content.leafLayers);
  int levelCount = 1;
  while ((size >> levelCount) > 0) ++levelCount;
  Texture maps = makeTexture(GL_TEXTURE_2D_ARRAY);
  glTextureStorage3D(maps.id(), levelCount, GL_SRGB8_ALPHA8, size, size,
                     static_cast<GLsizei>(content.leafLayers.size()));
  std::vector<vec4> layers;
  for (std::size_t i = 0; i < content.leafLayers.size(); ++i) {
    const LeafLayer& layer = content.leafLayers[i];
    const std::vector<MipLevel> levels = mipChain(layer.picture, size, size, true);
    for (int level = 0; level < levelCount; ++level) {
      const MipLevel& from = levels[static_cast<std::size_t>(level)];
      glTextureSubImage3D(maps.id(), level, 0, 0, static_cast<GLint>(i), from.width, from.height, 1, GL_RGBA,
                          GL_UNSIGNED_BYTE, from.rgba.data());
    }
    layers.emplace_back(layer.pivot, layer.extent);
  }
  glTextureParameteri(maps.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTextureParameteri(maps.id(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(maps.id(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  Buffer layerBuffer = makeBuffer(static_cast<GLsizeiptr>(layers.size() * sizeof(vec4)), layers.data(), 0);
  // Few leaves may be finely bent; a million are a crowd. Shadows need the same bends, or leaves shade themselves.
  grid_ = content.leafCount <= 20'000 ? makeGrid(3, 5) : content.leafCount <= 200'000 ? makeGrid(3, 3) : makeGrid(2, 2);
  if (outOfMemory()) return Error{"not enough graphics memory for the leaf textures"};
  maps_ = std::move(maps);
  layers_ = std::move(layerBuffer);
  return ok();
}

int LeafPass::drawGrid(GLuint buffer, GLintptr offset, std::size_t count) const {
  if (count == 0 || !maps_) return 0;
  glBindVertexArray(grid_.array.id());
  glVertexArrayVertexBuffer(grid_.array.id(), 1, buffer, offset, sizeof(LeafInstance));
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, layers_.id());
  glBindTextureUnit(3, maps_.id());
  glDrawElementsInstanced(GL_TRIANGLES, grid_.indexCount, GL_UNSIGNED_SHORT, nullptr, static_cast<GLsizei>(count));
  return 1;
}

int LeafPass::draw(GLuint buffer, GLintptr offset, std::size_t count, bool highQuality) const {
  glUseProgram((highQuality ? high_ : standard_).id());
  glEnable(GL_SAMPLE_ALPHA_TO_COVERAGE);
  const int calls = drawGrid(buffer, offset, count);
  glDisable(GL_SAMPLE_ALPHA_TO_COVERAGE);
  return calls;
}

int LeafPass::drawShadow(GLuint buffer, GLintptr offset, std::size_t count, const mat4& lightMatrix) const {
  glUseProgram(shadowProgram_.id());
  glUniformMatrix4fv(0, 1, GL_FALSE, glm::value_ptr(lightMatrix));
  return drawGrid(buffer, offset, count);
}

}  // namespace windfall::render
