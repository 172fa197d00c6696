#include "widgets/render/picture_target.h"

#include <cmath>
#include <string>

namespace windfall::render {

Status PictureTarget::resize(int width, int height) {
  if (width == width_ && height == height_) return ok();
  const Error failed{"not enough graphics memory for a picture of " + std::to_string(width) + "x" +
                     std::to_string(height) + " pixels"};
  GLint largest = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  if (width < 1 || height < 1 || width > largest || height > largest) return failed;
  clearErrors();
  // The old one goes first: both at once may not fit.
  framebuffer_.reset();
  color_.reset();
  depth_.reset();
  width_ = height_ = 0;
  Texture color = makeTexture(GL_TEXTURE_2D_MULTISAMPLE), depth = makeTexture(GL_TEXTURE_2D_MULTISAMPLE);
  glTextureStorage2DMultisample(color.id(), kSamples, GL_RGBA16F, width, height, GL_TRUE);
  glTextureStorage2DMultisample(depth.id(), kSamples, GL_DEPTH_COMPONENT32F, width, height, GL_TRUE);
  if (outOfMemory()) return failed;
  Framebuffer framebuffer = makeFramebuffer();
  glNamedFramebufferTexture(framebuffer.id(), GL_COLOR_ATTACHMENT0, color.id(), 0);
  glNamedFramebufferTexture(framebuffer.id(), GL_DEPTH_ATTACHMENT, depth.id(), 0);
  if (glCheckNamedFramebufferStatus(framebuffer.id(), GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) return failed;
  color_ = std::move(color);
  depth_ = std::move(depth);
  framebuffer_ = std::move(framebuffer);
  width_ = width;
  height_ = height;
  return ok();
}

std::array<GLint, 4> PictureTarget::samplesByQuarter() const {
  std::array<GLint, 4> nearest{};
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
  for (int quarter = 0; quarter < 4; ++quarter) {
    const float x = (quarter & 1) != 0 ? 0.75f : 0.25f, y = (quarter & 2) != 0 ? 0.75f : 0.25f;
    float least = 2;
    for (GLint sample = 0; sample < kSamples; ++sample) {
      GLfloat at[2];
      glGetMultisamplefv(GL_SAMPLE_POSITION, static_cast<GLuint>(sample), at);
      const float distance = std::hypot(at[0] - x, at[1] - y);
      if (distance < least) least = distance, nearest[static_cast<std::size_t>(quarter)] = sample;
    }
  }
  return nearest;
}

}  // namespace windfall::render
