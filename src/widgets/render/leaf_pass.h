// Draws all leaves from their layers' meshes, level by level of detail, in one indirect call.
#pragma once

#include <cstddef>

#include "sim/result.h"
#include "widgets/render/content.h"
#include "widgets/render/gl_object.h"
#include "widgets/render/leaf_maps.h"
#include "widgets/render/leaf_meshes.h"
#include "widgets/render/leaf_sort.h"

namespace windfall::render {

class LeafPass {
 public:
  Status compile();
  Status setContent(const SceneContent& content);
  /// Sorts the leaves of `buffer` at `offset` (LeafInstance) for this frame; before the draws.
  void sort(GLuint buffer, GLintptr offset, const LeafSight& sight, float season, const LeafCardBinding& cards = {});
  /// Draw calls made: one, or one for each two million leaves.
  int draw(bool highQuality) const;
  int drawShadow(const mat4& lightMatrix) const;
  const LeafMeshBuffers& meshes() const { return meshes_; }
  /// Binds the layers (storage 2) and their maps.
  void bindLooks() const;

 private:
  int drawKinds(std::size_t kinds) const;

  LeafMeshBuffers meshes_;
  LeafMapArrays maps_;
  LeafSort sort_;
  Buffer layers_;
  std::size_t layerCount_ = 0;
  GLuint leaves_ = 0;
  GLintptr offset_ = 0;
  float season_ = 0;
  LeafCardBinding cards_;
  Program standard_, high_, shadowProgram_;
};

}  // namespace windfall::render
