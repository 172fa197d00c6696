// Sorts a frame's leaves by level of detail and layer on the device that draws them.
#pragma once

#include <cstddef>
#include <vector>

#include "sim/result.h"
#include "widgets/render/gl_object.h"
#include "widgets/render/leaf_meshes.h"

namespace windfall::render {

/// From where leaves are judged.
struct LeafSight {
  mat4 viewProjection{1};
  vec3 eye{0};
  float pixelsPerRadian = 1000;
  float thinBelow = 4;     ///< px of a leaf's length: of smaller ones a share is drawn, larger in turn
  float budget = 200'000;  ///< leaves to be drawn at most, those of more than 20 px and in the air not counted
};

/// What says of each leaf how far its cluster is drawn as a card; no buffers: every leaf is drawn.
struct LeafCardBinding {
  GLuint ofLeaf = 0, states = 0;
  explicit operator bool() const { return ofLeaf != 0; }
  /// Binds both for the leaves from `first` on (storage 9 and 10), and tells the program in use.
  void bind(std::size_t first, std::size_t count) const;
};

/// A part of the leaves that one storage block can hold.
struct LeafChunk {
  GLintptr offset = 0;  ///< in the leaves' buffer
  std::size_t first = 0;
  std::size_t count = 0;
  Buffer commands, lists;
};

class LeafSort {
 public:
  Status compile();
  /// Room for this many leaves; `commands` without instances.
  Status allocate(std::size_t leafCount, const std::vector<DrawCommand>& commands);
  /// Thins leaves that are small on the screen, so that the area that they cover stays; fills the chunks' commands and
  /// lists from the leaves in `buffer` at `offset`. Leaves whose card has taken their place add to it and are left out.
  /// The layers' block must be bound.
  void run(GLuint buffer, GLintptr offset, const LeafSight& sight, const LeafCardBinding& cards = {});
  const std::vector<LeafChunk>& chunks() const { return chunks_; }

 private:
  void bind(const LeafChunk& chunk) const;

  Program demand_, count_, plan_, place_;
  std::vector<LeafChunk> chunks_;
  Buffer fresh_, cursors_, buckets_, wanted_;
  std::size_t leaves_ = 0;
  GLsizeiptr commandBytes_ = 0, cursorBytes_ = 0;
};

}  // namespace windfall::render
