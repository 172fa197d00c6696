// The multisampled high dynamic range target that a frame is drawn into before it is developed.
#pragma once

#include <array>

#include "sim/result.h"
#include "widgets/render/gl_object.h"

namespace windfall::render {

class PictureTarget {
 public:
  /// Keeps what it has where the size is the same.
  Status resize(int width, int height);
  GLuint framebuffer() const { return framebuffer_.id(); }
  GLuint color() const { return color_.id(); }
  GLuint depth() const { return depth_.id(); }
  /// Which sample lies in each quarter of a pixel: left and right below, left and right above.
  std::array<GLint, 4> samplesByQuarter() const;
  static constexpr int kSamples = 4;

 private:
  Texture color_, depth_;
  Framebuffer framebuffer_;
  int width_ = 0, height_ = 0;
};

}  // namespace windfall::render
