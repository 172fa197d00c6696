// OpenGL without a window, for pictures on the command line and for tests.
#pragma once

#include <memory>

#include "sim/result.h"
#include "widgets/render/content.h"

namespace windfall::render {

/// An OpenGL 4.5 context without a window or a display (EGL), current as long as it lives, with a framebuffer of its
/// own.
class OffscreenContext {
 public:
  /// Tries EGL's surfaceless platform, then its default display. One clear line where neither gives OpenGL 4.5.
  static Result<std::unique_ptr<OffscreenContext>> create(int width, int height);
  ~OffscreenContext();
  OffscreenContext(const OffscreenContext&) = delete;
  OffscreenContext& operator=(const OffscreenContext&) = delete;

  /// Gives the framebuffer another size; its picture is lost.
  Status resize(int width, int height);
  unsigned framebuffer() const;
  /// The framebuffer's picture, rows from the top, opaque.
  Picture read() const;

 private:
  OffscreenContext();
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace windfall::render
