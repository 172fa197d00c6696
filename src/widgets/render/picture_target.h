// The multisampled high dynamic range target that a frame is drawn into before it is developed.
#pragma once

#include "sim/result.h"
#include "widgets/render/gl_object.h"

namespace windfall::render {

class PictureTarget {
 public:
  /// Keeps what it has where the size is the same.
  Status resize(int width, int height);
  GLuint framebuffer() const { return framebuffer_.id(); }
  GLuint color() const { return color_.id(); }
  static constexpr int kSamples = 4;

 private:
  Texture color_, depth_;
  Framebuffer framebuffer_;
  int width_ = 0, height_ = 0;
};

}  // namespace windfall::render
