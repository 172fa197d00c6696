#include "widgets/render/part_pieces.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace windfall::render {

namespace {
constexpr float kWidest = 0.35f;       // px that pieces are drawn wide at least, as in pieces.glsl
constexpr float kFadingArea = 0.875f;  // of what is drawn, since the last quarter of it tapers to nothing
constexpr float kNear = 0.1f;          // m
}  // namespace

std::size_t piecesShown(std::size_t pieces, float width) {
  const double share = std::min(1.0, static_cast<double>(width / (kWidest * kFadingArea)));
  return std::min(pieces, static_cast<std::size_t>(std::ceil(share * static_cast<double>(pieces))));
}

PartPieces::PartPieces(const Part& part, std::span<const std::uint32_t> indices, std::vector<std::uint32_t> firstLinks,
                       float reach)
    : part_(part), firstLinks_(std::move(firstLinks)), reach_(reach), commands_(firstLinks_.size()) {
  const auto own = indices.subspan(part.firstIndex, part.indexCount);
  const auto [least, most] = std::minmax_element(own.begin(), own.end());
  firstVertex_ = *least;
  vertices_ = *most - *least + 1;
  for (std::size_t i = 0; i < commands_.size(); ++i) {
    commands_[i].first = part.firstIndex;
    commands_[i].baseInstance = static_cast<GLuint>(i);
  }
  buffer_ =
      makeBuffer(static_cast<GLsizeiptr>(commands_.size() * sizeof(Command)), commands_.data(), GL_DYNAMIC_STORAGE_BIT);
}

bool PartPieces::draw(const PieceSight& sight, std::span<const mat4> bones) {
  bool any = false;
  const GLuint each = part_.indexCount / part_.pieces;
  for (std::size_t i = 0; i < commands_.size(); ++i) {
    const vec3 root = firstLinks_[i] < bones.size() ? vec3(bones[firstLinks_[i]][3]) : vec3(0);
    const float far = sight.parallel ? 1.f : std::max(glm::distance(root, sight.eye) - reach_, kNear);
    const std::size_t shown = piecesShown(part_.pieces, part_.width * sight.pixels / far);
    commands_[i].count = each * static_cast<GLuint>(shown);
    any = any || shown > 0;
  }
  if (!any) return false;
  glNamedBufferSubData(buffer_.id(), 0, static_cast<GLsizeiptr>(commands_.size() * sizeof(Command)), commands_.data());
  glUniform4f(2, sight.eye.x, sight.eye.y, sight.eye.z, sight.parallel ? -sight.pixels : sight.pixels);
  glUniform4f(3, static_cast<float>(firstVertex_), static_cast<float>(vertices_), part_.width, reach_);
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, buffer_.id());
  glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, nullptr, static_cast<GLsizei>(commands_.size()), 0);
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, 0);
  return true;
}

}  // namespace windfall::render
