// Parts of many small pieces, such as short shoots: from afar fewer of them are drawn, and wider, so that as much of
// the picture is covered; no piece appears at once.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "widgets/render/content.h"
#include "widgets/render/gl_object.h"

namespace windfall::render {

/// How large a metre is: px at a distance of one metre from `eye`, or the same everywhere (a shadow map's texels).
struct PieceSight {
  vec3 eye{0};
  float pixels = 1000;
  bool parallel = false;
};

/// Pieces of a part that are drawn where they are `width` px wide (as in pieces.glsl).
std::size_t piecesShown(std::size_t pieces, float width);

/// The draw commands of one such part, a tree each.
class PartPieces {
 public:
  /// The part's place in the mesh and the trees' first links; `reach`: m from a tree's root to what is farthest.
  PartPieces(const Part& part, std::span<const std::uint32_t> indices, std::vector<std::uint32_t> firstLinks,
             float reach);
  /// Draws what is wanted; the mesh's arrays and a program that includes pieces.glsl are bound. False: nothing is seen.
  bool draw(const PieceSight& sight, std::span<const mat4> bones);

 private:
  struct Command {
    GLuint count = 0, instances = 1, first = 0;
    GLint baseVertex = 0;
    GLuint baseInstance = 0;
  };
  Part part_;
  std::vector<std::uint32_t> firstLinks_;
  float reach_ = 0;
  std::uint32_t firstVertex_ = 0, vertices_ = 0;
  std::vector<Command> commands_;
  Buffer buffer_;
};

}  // namespace windfall::render
