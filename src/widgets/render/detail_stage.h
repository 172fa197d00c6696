// Trees alone against nothing, in the light of a clear day: for comparing meshes of the same trees.
#pragma once

#include <memory>
#include <span>

#include "sim/result.h"
#include "widgets/render/content.h"
#include "widgets/render/detail_pass.h"
#include "widgets/render/view.h"

namespace windfall::render {

/// Draws the meshes, or the adaptive meshes, of trees with the renderer's own shaders; without ground, sky, shadows,
/// and leaves, so that frames cost what the trees cost. Needs a current context as long as it lives.
class DetailStage {
 public:
  static Result<std::unique_ptr<DetailStage>> create(int width, int height);
  ~DetailStage();
  DetailStage(const DetailStage&) = delete;
  DetailStage& operator=(const DetailStage&) = delete;

  Status setContent(const SceneContent& content);
  /// Draws a frame with these matrices, one a link, and waits for it; returns the milliseconds of both. `smooth`: with
  /// the renderer's samples a pixel, resolved.
  double draw(const View& view, std::span<const mat4> bones, bool adaptive, bool smooth = false);
  /// What was drawn: alpha is the share of a pixel where a tree is.
  Picture read() const;
  /// Of the last adaptive frame.
  DetailCounts counts() const;
  DetailPass& adaptive();

 private:
  DetailStage();
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace windfall::render
