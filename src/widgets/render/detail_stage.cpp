#include "widgets/render/detail_stage.h"

#include <algorithm>
#include <chrono>
#include <cstring>

#include "widgets/render/frame_ring.h"
#include "widgets/render/frame_uniforms.h"
#include "widgets/render/noise_texture.h"
#include "widgets/render/picture_target.h"
#include "widgets/render/shadow_map.h"
#include "widgets/render/sky_model.h"
#include "widgets/render/tree_pass.h"

namespace windfall::render {

struct DetailStage::Impl {
  int width = 0, height = 0;
  TreePass trees;
  DetailPass adaptive;
  FrameRing ring;
  ShadowMap shadow;
  Texture color, depth, noise, skyTable;
  Texture smoothColor, smoothDepth;
  Framebuffer framebuffer, smooth;
  Buffer uniforms, highlights, linkColors;
  SkyLight sky;
};

DetailStage::DetailStage() : impl_(std::make_unique<Impl>()) {}
DetailStage::~DetailStage() = default;

Result<std::unique_ptr<DetailStage>> DetailStage::create(int width, int height) {
  std::unique_ptr<DetailStage> made(new DetailStage);
  Impl& impl = *made->impl_;
  impl.width = width;
  impl.height = height;
  if (const Status compiled = impl.trees.compile(); !compiled) return compiled.error();
  if (const Status compiled = impl.adaptive.compile(); !compiled) return compiled.error();
  clearErrors();
  impl.color = makeTexture(GL_TEXTURE_2D);
  glTextureStorage2D(impl.color.id(), 1, GL_RGBA8, width, height);
  impl.depth = makeTexture(GL_TEXTURE_2D);
  glTextureStorage2D(impl.depth.id(), 1, GL_DEPTH_COMPONENT32F, width, height);
  impl.framebuffer = makeFramebuffer();
  glNamedFramebufferTexture(impl.framebuffer.id(), GL_COLOR_ATTACHMENT0, impl.color.id(), 0);
  glNamedFramebufferTexture(impl.framebuffer.id(), GL_DEPTH_ATTACHMENT, impl.depth.id(), 0);
  impl.smoothColor = makeTexture(GL_TEXTURE_2D_MULTISAMPLE);
  glTextureStorage2DMultisample(impl.smoothColor.id(), PictureTarget::kSamples, GL_RGBA8, width, height, GL_TRUE);
  impl.smoothDepth = makeTexture(GL_TEXTURE_2D_MULTISAMPLE);
  glTextureStorage2DMultisample(impl.smoothDepth.id(), PictureTarget::kSamples, GL_DEPTH_COMPONENT32F, width, height,
                                GL_TRUE);
  impl.smooth = makeFramebuffer();
  glNamedFramebufferTexture(impl.smooth.id(), GL_COLOR_ATTACHMENT0, impl.smoothColor.id(), 0);
  glNamedFramebufferTexture(impl.smooth.id(), GL_DEPTH_ATTACHMENT, impl.smoothDepth.id(), 0);
  impl.noise = makeNoiseTexture();
  impl.sky = computeSky(glm::normalize(vec3(0.5f, 0.6f, 0.6f)), vec3(0.13f, 0.10f, 0.035f));
  impl.skyTable = makeTexture(GL_TEXTURE_2D);
  glTextureStorage2D(impl.skyTable.id(), 1, GL_RGB16F, SkyLight::kWidth, SkyLight::kHeight);
  glTextureSubImage2D(impl.skyTable.id(), 0, 0, 0, SkyLight::kWidth, SkyLight::kHeight, GL_RGB, GL_FLOAT,
                      impl.sky.table.data());
  const std::uint32_t none = 0;
  impl.linkColors = makeBuffer(sizeof none, &none, 0);
  impl.uniforms = makeBuffer(sizeof(FrameUniforms), nullptr, GL_DYNAMIC_STORAGE_BIT);
  if (const Status sized = impl.shadow.resize(16); !sized) return sized.error();
  const float farthest = 1;
  glClearNamedFramebufferfv(impl.shadow.framebuffer(), GL_DEPTH, 0, &farthest);
  if (outOfMemory()) return Error{"not enough graphics memory"};
  return made;
}

Status DetailStage::setContent(const SceneContent& content) {
  Status status = impl_->trees.setContent(content);
  if (status) status = impl_->adaptive.setContent(content);
  if (status) status = impl_->ring.allocate(content.linkCount, 0);
  const std::vector<std::uint32_t> bits(content.linkCount / 32 + 1, 0u);
  impl_->highlights = makeBuffer(static_cast<GLsizeiptr>(bits.size() * sizeof(std::uint32_t)), bits.data(), 0);
  return status;
}

double DetailStage::draw(const View& view, std::span<const mat4> bones, bool adaptive, bool smooth) {
  Impl& impl = *impl_;
  glFinish();
  const auto begin = std::chrono::steady_clock::now();
  const FrameSlot slot = impl.ring.acquire();
  std::copy_n(bones.begin(), std::min(bones.size(), slot.bones.size()), slot.bones.begin());
  impl.ring.publish(slot.index);
  View shown = view;
  shown.width = impl.width;
  shown.height = impl.height;
  shown.toSun = glm::normalize(vec3(0.5f, 0.6f, 0.6f));
  const FrameUniforms uniforms = frameUniforms(shown, impl.sky, fitShadow(vec3(0), 1000, shown.toSun, 16));
  glNamedBufferSubData(impl.uniforms.id(), 0, sizeof uniforms, &uniforms);
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_TRUE);
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glDepthFunc(GL_GEQUAL);
  const GLuint target = (smooth ? impl.smooth : impl.framebuffer).id();
  glBindFramebuffer(GL_FRAMEBUFFER, target);
  glViewport(0, 0, impl.width, impl.height);
  const float nothing[4] = {0, 0, 0, 0};
  glClearNamedFramebufferfv(target, GL_COLOR, 0, nothing);
  glClearNamedFramebufferfv(target, GL_DEPTH, 0, nothing);
  glBindBufferBase(GL_UNIFORM_BUFFER, 0, impl.uniforms.id());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, impl.highlights.id());
  glBindBufferRange(GL_SHADER_STORAGE_BUFFER, 0, impl.ring.bones(), impl.ring.boneOffset(slot.index),
                    static_cast<GLsizeiptr>(impl.ring.linkCount() * sizeof(mat4)));
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 7, impl.linkColors.id());
  glBindTextureUnit(0, impl.noise.id());
  glBindTextureUnit(1, impl.skyTable.id());
  glBindTextureUnit(2, impl.shadow.texture());
  if (adaptive) {
    impl.adaptive.choose(DetailPass::Target::Picture, detailCamera(shown, view.tolerance), slot.bones);
    impl.adaptive.draw(false);
  } else {
    impl.trees.draw(false, false, {view.eye, view.pixelsPerRadian()}, bones);
  }
  if (smooth) {
    glBlitNamedFramebuffer(target, impl.framebuffer.id(), 0, 0, impl.width, impl.height, 0, 0, impl.width, impl.height,
                           GL_COLOR_BUFFER_BIT, GL_NEAREST);
  }
  impl.ring.fence(slot.index);
  glFinish();
  const double time = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
  glDepthFunc(GL_LESS);
  glUseProgram(0);
  glBindVertexArray(0);
  return time;
}

Picture DetailStage::read() const {
  Picture picture{impl_->width, impl_->height, {}};
  const auto row = static_cast<std::size_t>(picture.width) * 4;
  std::vector<std::uint8_t> upward(row * static_cast<std::size_t>(picture.height));
  glGetTextureImage(impl_->color.id(), 0, GL_RGBA, GL_UNSIGNED_BYTE, static_cast<GLsizei>(upward.size()),
                    upward.data());
  picture.rgba.resize(upward.size());
  for (int y = 0; y < picture.height; ++y) {
    std::memcpy(picture.rgba.data() + row * static_cast<std::size_t>(y),
                upward.data() + row * static_cast<std::size_t>(picture.height - 1 - y), row);
  }
  return picture;
}

DetailCounts DetailStage::counts() const { return impl_->adaptive.counts(); }
DetailPass& DetailStage::adaptive() { return impl_->adaptive; }

}  // namespace windfall::render
