// The shapes of all layers' leaves in one vertex and one index buffer.
#pragma once

#include <array>
#include <vector>

#include "widgets/render/content.h"
#include "widgets/render/gl_object.h"

namespace windfall::render {

/// As OpenGL reads it for an indirect draw.
struct DrawCommand {
  GLuint count = 0, instances = 0, firstIndex = 0;
  GLint baseVertex = 0;
  GLuint baseInstance = 0;
};

/// Kinds of leaves in a frame: four levels in view, then levels 2 and 3 of what only throws shadows.
inline constexpr std::size_t kLeafKinds = 6;

/// Attributes 0 place, 1 rib and level, 2 corner of the picture; 3 is the leaf's number, from binding 1.
class LeafMeshBuffers {
 public:
  void upload(const std::vector<LeafLayer>& layers);
  GLuint array() const { return array_.id(); }
  /// A further one of the same attributes.
  VertexArray makeArray() const;
  /// A command for each kind and layer, kinds first, without instances.
  const std::vector<DrawCommand>& commands() const { return commands_; }

 private:
  VertexArray array_;
  Buffer vertices_, indices_;
  std::vector<DrawCommand> commands_;
};

/// A layer's shapes as they are drawn: its own, or grids.
std::array<LeafShape, kLeafLevels> shapesOf(const LeafLayer& layer);

/// A grid over a layer's picture, for layers without shapes.
LeafShape gridShape(const LeafLayer& layer, int columns, int rows);

}  // namespace windfall::render
