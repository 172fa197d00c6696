// Draws all leaves in one call from a texture array.
#pragma once

#include <cstddef>

#include "sim/result.h"
#include "widgets/render/content.h"
#include "widgets/render/gl_object.h"

namespace windfall::render {

class LeafPass {
 public:
  Status compile();
  /// Uploads the layers; `leafCount` decides how fine a leaf's grid may be.
  Status setContent(const SceneContent& content);
  /// Leaves from `buffer` at `offset` (LeafInstance); draw calls made.
  int draw(GLuint buffer, GLintptr offset, std::size_t count, bool highQuality) const;
  int drawShadow(GLuint buffer, GLintptr offset, std::size_t count, const mat4& lightMatrix) const;

 private:
  struct Grid {
    VertexArray array;
    Buffer vertices, indices;
    GLsizei indexCount = 0;
  };
  static Grid makeGrid(int columns, int rows);
  int drawGrid(GLuint buffer, GLintptr offset, std::size_t count) const;

  Grid grid_;
  Texture maps_;
  Buffer layers_;
  Program standard_, high_, shadowProgram_;
};

}  // namespace windfall::render
