#include "widgets/render/renderer.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

#include <glm/geometric.hpp>

#include "widgets/render/detail_pass.h"
#include "widgets/render/frame_ring.h"
#include "widgets/render/frame_uniforms.h"
#include "widgets/render/gl_object.h"
#include "widgets/render/gl_version.h"
#include "widgets/render/leaf_cards.h"
#include "widgets/render/leaf_pass.h"
#include "widgets/render/noise_texture.h"
#include "widgets/render/picture_target.h"
#include "widgets/render/scene_extent.h"
#include "widgets/render/shader_program.h"
#include "widgets/render/shadow_map.h"
#include "widgets/render/sky_model.h"
#include "widgets/render/streak_pass.h"
#include "widgets/render/tree_pass.h"

namespace windfall::render {

namespace {
const vec3 kGroundAlbedo(0.13f, 0.10f, 0.035f);
constexpr float kThinLive = 4, kThinKept = 2;                       // px of a leaf's length
constexpr std::size_t kPainted = 100'000, kSoftwarePainted = 4000;  // leaves a frame, into pictures for cards
constexpr float kLeaves = 200'000, kSoftwareLeaves = 25'000, kNoBudget = 1e9f;
constexpr float kGrassHeight = 0.055f;                              // m
constexpr int kGrassRings = 3, kGrassCells = 80, kGrassBlades = 5;  // as in grass.vert
}  // namespace

struct Renderer::Impl {
  FrameRing ring;
  TreePass trees;
  DetailPass detail;
  LeafPass leaves;
  LeafCards cards;
  StreakPass streaks;
  PictureTarget fine, coarse;
  ShadowMap shadow;
  SceneExtent extent;
  Program sky, ground[2], grass, present;
  Texture noise, skyTable;
  Buffer uniforms, highlights, linkColors;
  VertexArray empty;
  SkyLight skyLight;
  vec3 skySun{0};
  std::vector<std::uint32_t> highlighted, highlightBits, shownColors;
  bool software = false;
  std::array<GLint, 4> quarters{};
  double drawTime = 0;
  DrawCounts counts;

  Status compile();
  void updateSky(const View& view);
  void updateHighlights(const View& view);
  void makeHighlights(std::size_t linkCount);
  void updateLinkColors(const View& view);
  void makeLinkColors();
  void sortLeaves(const View& view, const FrameUniforms& frame);
  void chooseDetail(const View& view, const ShadowFit& fit);
  void drawShadows(const View& view, const ShadowFit& fit);
  void drawPicture(const View& view);
  void drawPresent(const View& view, unsigned framebuffer);
  PictureTarget& target(bool isCoarse) { return isCoarse ? coarse : fine; }
  int shadowSize(Quality quality) const;
  bool drawsGrass(Quality quality) const {
    return quality == Quality::High || (quality == Quality::Standard && !software);
  }
  void bindFrame() const;
};

Status Renderer::Impl::compile() {
  const auto link = [](Program& into, const char* vertex, const char* fragment, const char* define) -> Status {
    Result<Program> linked = linkProgram(vertex, fragment, {define});
    if (!linked) return linked.error();
    into = std::move(*linked);
    return ok();
  };
  const std::string samples = "SAMPLES " + std::to_string(PictureTarget::kSamples);
  for (const Status& status : {link(sky, "sky.vert", "sky.frag", "STANDARD_QUALITY"),
                               link(ground[0], "ground.vert", "ground.frag", "STANDARD_QUALITY"),
                               link(ground[1], "ground.vert", "ground.frag", "HIGH_QUALITY"),
                               link(grass, "grass.vert", "grass.frag", "STANDARD_QUALITY"),
                               link(present, "present.vert", "present.frag", samples.c_str()), trees.compile(),
                               detail.compile(), leaves.compile(), cards.compile(), streaks.compile()}) {
    if (!status) return status;
  }
  return ok();
}

void Renderer::Impl::updateSky(const View& view) {
  const vec3 sun = glm::length(view.toSun) > 1e-6f ? glm::normalize(view.toSun) : vec3(0, 1, 0);
  if (sun == skySun) return;
  skySun = sun;
  skyLight = computeSky(sun, kGroundAlbedo);
  glTextureSubImage2D(skyTable.id(), 0, 0, 0, SkyLight::kWidth, SkyLight::kHeight, GL_RGB, GL_FLOAT,
                      skyLight.table.data());
}

void Renderer::Impl::makeHighlights(std::size_t linkCount) {
  highlightBits.assign(linkCount / 32 + 1, 0u);
  highlighted.clear();
  highlights = makeBuffer(static_cast<GLsizeiptr>(highlightBits.size() * sizeof(std::uint32_t)), highlightBits.data(),
                          GL_DYNAMIC_STORAGE_BIT);
}

void Renderer::Impl::updateHighlights(const View& view) {
  if (view.highlighted == highlighted) return;
  highlighted = view.highlighted;
  std::fill(highlightBits.begin(), highlightBits.end(), 0u);
  for (const std::uint32_t link : highlighted) {
    if (link < ring.linkCount()) highlightBits[link / 32] |= 1u << (link % 32);
  }
  glNamedBufferSubData(highlights.id(), 0, static_cast<GLsizeiptr>(highlightBits.size() * sizeof(std::uint32_t)),
                       highlightBits.data());
}

/// One more than there are links, so that a length of one says that there are none.
void Renderer::Impl::makeLinkColors() {
  std::vector<std::uint32_t> padded(shownColors.empty() ? 1 : ring.linkCount() + 1, 0u);
  std::copy_n(shownColors.begin(), std::min(shownColors.size(), ring.linkCount()), padded.begin());
  linkColors = makeBuffer(static_cast<GLsizeiptr>(padded.size() * sizeof(std::uint32_t)), padded.data(), 0);
}

void Renderer::Impl::updateLinkColors(const View& view) {
  if (view.linkColors == shownColors) return;
  shownColors = view.linkColors;
  makeLinkColors();
}

int Renderer::Impl::shadowSize(Quality quality) const {
  if (quality == Quality::High) return software ? 2048 : 4096;
  return quality == Quality::Draft || software ? 1024 : 2048;
}

void Renderer::Impl::bindFrame() const {
  glBindBufferBase(GL_UNIFORM_BUFFER, 0, uniforms.id());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, highlights.id());
  const int slot = ring.newest();
  if (slot >= 0 && ring.linkCount() > 0) {
    glBindBufferRange(GL_SHADER_STORAGE_BUFFER, 0, ring.bones(), ring.boneOffset(slot),
                      static_cast<GLsizeiptr>(ring.linkCount() * sizeof(mat4)));
  }
}

void Renderer::Impl::sortLeaves(const View& view, const FrameUniforms& frame) {
  const int slot = ring.newest();
  if (slot < 0) return;
  const bool high = view.quality == Quality::High;
  const float scale = view.pixelsPerRadian();
  // A processor draws the few leaves that it can afford sooner than cards, which show what all leaves would.
  const float share = view.coarse ? 0 : high ? 0.5f : 1;
  const CardSight far{frame.viewProjection,
                      view.eye,
                      scale,
                      share * view.cardsBelow,
                      view.season,
                      high,
                      software ? kSoftwarePainted : kPainted};
  const LeafCardBinding binding = cards.choose(far, ring.slot(slot).bones, leaves);
  const LeafSight sight{frame.viewProjection, view.eye, scale, high ? kThinKept : kThinLive,
                        high       ? kNoBudget
                        : software ? (view.coarse ? 0.5f : 1.f) * kSoftwareLeaves
                                   : kLeaves};
  leaves.sort(ring.leaves(), ring.leafOffset(slot), sight, view.season, binding);
  cards.list(far);
  counts.unfinished = cards.unfinished();
}

void Renderer::Impl::chooseDetail(const View& view, const ShadowFit& fit) {
  const int slot = ring.newest();
  if (slot < 0 || !view.adaptive || detail.empty()) return;
  const std::span<const mat4> bones = ring.slot(slot).bones;
  const float tolerance = view.quality == Quality::High ? 0.5f * view.tolerance : view.tolerance;
  detail.choose(DetailPass::Target::Shadow, shadowDetailCamera(fit.texel), bones);
  detail.choose(DetailPass::Target::Picture, detailCamera(view, tolerance), bones);
}

void Renderer::Impl::drawShadows(const View& view, const ShadowFit& fit) {
  glBindFramebuffer(GL_FRAMEBUFFER, shadow.framebuffer());
  glViewport(0, 0, shadow.size(), shadow.size());
  glDepthFunc(GL_LESS);
  const float farthest = 1;
  glClearNamedFramebufferfv(shadow.framebuffer(), GL_DEPTH, 0, &farthest);
  const int slot = ring.newest();
  if (slot < 0) return;
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(1.2f, 1.f);
  counts.calls += trees.drawShadow(fit.toClip, view.adaptive, {vec3(0), 1 / fit.texel, true}, ring.slot(slot).bones);
  if (view.adaptive) counts.calls += detail.drawShadow(fit.toClip);
  counts.calls += leaves.drawShadow(fit.toClip);
  glBindTextureUnit(0, noise.id());
  counts.calls += cards.drawShadow(fit.toClip, 1 / fit.texel);
  glDisable(GL_POLYGON_OFFSET_FILL);
}

void Renderer::Impl::drawPicture(const View& view) {
  const bool high = view.quality == Quality::High;
  const GLuint framebuffer = target(view.coarse).framebuffer();
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glViewport(0, 0, view.width, view.height);
  const float farthest = 0;
  glClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, &farthest);
  glDepthFunc(GL_GEQUAL);
  glBindTextureUnit(0, noise.id());
  glBindTextureUnit(1, skyTable.id());
  glBindTextureUnit(2, shadow.texture());
  // Front to back: the ground and the sky fill only what the tree leaves open.
  if (const int slot = ring.newest(); slot >= 0) {
    // The adaptive mesh's selection has had this place since the frame was bound.
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 7, linkColors.id());
    counts.calls += trees.draw(high, view.adaptive, {view.eye, view.pixelsPerRadian()}, ring.slot(slot).bones);
    if (view.adaptive) counts.calls += detail.draw(high);
    counts.leafCalls = leaves.draw(high);
    counts.cardCalls = cards.draw(high, view.season);
    counts.calls += counts.leafCalls + counts.cardCalls;
  }
  glBindVertexArray(empty.id());
  if (drawsGrass(view.quality)) {
    glUseProgram(grass.id());
    glDrawArraysInstanced(GL_TRIANGLES, 0, 3 * kGrassBlades, kGrassRings * kGrassCells * kGrassCells);
    ++counts.calls;
  }
  glUseProgram(ground[high ? 1 : 0].id());
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  glUseProgram(sky.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  counts.calls += 2 + streaks.draw(view.streaks, view.streakPoints);
}

void Renderer::Impl::drawPresent(const View& view, unsigned framebuffer) {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glViewport(0, 0, view.width, view.height);
  glDisable(GL_DEPTH_TEST);
  glBindTextureUnit(3, target(view.coarse).color());
  glUseProgram(present.id());
  glUniform1i(0, view.coarse ? 2 : 1);
  glUniform4iv(1, 1, quarters.data());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  ++counts.calls;
}

Renderer::Renderer() : impl_(std::make_unique<Impl>()) {}
Renderer::~Renderer() = default;

Result<std::unique_ptr<Renderer>> Renderer::create() {
  if (const Status version = checkVersion(); !version) return version.error();
  std::unique_ptr<Renderer> made(new Renderer);
  Impl& impl = *made->impl_;
  impl.software = render::isSoftware();
  if (const Status compiled = impl.compile(); !compiled) return compiled.error();
  clearErrors();
  impl.noise = makeNoiseTexture();
  impl.skyTable = makeTexture(GL_TEXTURE_2D);
  glTextureStorage2D(impl.skyTable.id(), 1, GL_RGB16F, SkyLight::kWidth, SkyLight::kHeight);
  glTextureParameteri(impl.skyTable.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTextureParameteri(impl.skyTable.id(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(impl.skyTable.id(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  impl.uniforms = makeBuffer(sizeof(FrameUniforms), nullptr, GL_DYNAMIC_STORAGE_BIT);
  impl.makeHighlights(0);
  impl.makeLinkColors();
  impl.empty = makeVertexArray();
  if (outOfMemory()) return Error{"not enough graphics memory"};
  return made;
}

Status Renderer::setContent(const SceneContent& content) {
  impl_->extent.reset();
  Status status = impl_->trees.setContent(content);
  if (status) status = impl_->detail.setContent(content);
  if (status) status = impl_->leaves.setContent(content);
  if (status) status = impl_->ring.allocate(content.linkCount, content.leafCount);
  if (!status) {
    static_cast<void>(impl_->trees.setContent({}));
    static_cast<void>(impl_->detail.setContent({}));
    static_cast<void>(impl_->leaves.setContent({}));
    static_cast<void>(impl_->ring.allocate(0, 0));
  }
  if (status) {
    impl_->cards.setContent(content, impl_->leaves);
  } else {
    impl_->cards.setContent({}, impl_->leaves);
  }
  impl_->makeHighlights(impl_->ring.linkCount());
  impl_->makeLinkColors();
  return status;
}

FrameSlot Renderer::acquire() { return impl_->ring.acquire(); }

void Renderer::publish(const FrameSlot& slot) {
  impl_->ring.publish(slot.index);
  if (impl_->ring.newest() == slot.index && slot.index >= 0)
    impl_->extent.update(impl_->trees, impl_->ring.slot(slot.index));
}

Status Renderer::draw(const View& view, unsigned framebuffer) {
  const auto begin = std::chrono::steady_clock::now();
  Impl& impl = *impl_;
  impl.counts = {};
  impl.counts.slot = impl.ring.newest();
  View lit = view;
  if (view.coarse) lit.width = (view.width + 1) / 2, lit.height = (view.height + 1) / 2;
  if (const Status sized = impl.target(view.coarse).resize(lit.width, lit.height); !sized) return sized;
  if (view.coarse) impl.quarters = impl.coarse.samplesByQuarter();
  if (const Status sized = impl.shadow.resize(impl.shadowSize(view.quality)); !sized) return sized;
  impl.updateSky(view);
  impl.updateHighlights(view);
  impl.updateLinkColors(view);
  const ShadowFit fit = fitShadow(impl.extent.center(), impl.extent.radius(), impl.skySun, impl.shadow.size());
  lit.adaptive = view.adaptive || impl.trees.needsAdaptive();
  lit.toSun = impl.skySun;
  FrameUniforms uniforms = frameUniforms(lit, impl.skyLight, fit);
  setCanopies(uniforms, impl.extent.canopies());
  if (impl.drawsGrass(view.quality)) uniforms.grass = vec4(kGrassHeight, kGrassCells, 0, 0);
  glNamedBufferSubData(impl.uniforms.id(), 0, sizeof uniforms, &uniforms);

  // Whatever was drawn before in this context may have left anything on.
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_STENCIL_TEST);
  glDisable(GL_FRAMEBUFFER_SRGB);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDepthMask(GL_TRUE);
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_MULTISAMPLE);
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  impl.bindFrame();
  impl.sortLeaves(lit, uniforms);
  impl.chooseDetail(lit, fit);
  impl.drawShadows(lit, fit);
  impl.drawPicture(lit);
  impl.drawPresent(view, framebuffer);
  if (impl.counts.slot >= 0) impl.ring.fence(impl.counts.slot);

  glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
  glDepthFunc(GL_LESS);
  glUseProgram(0);
  glBindVertexArray(0);
  impl.drawTime = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  return ok();
}

std::string Renderer::name() const { return deviceName(); }
bool Renderer::isSoftware() const { return impl_->software; }
double Renderer::lastDrawTime() const { return impl_->drawTime; }
DrawCounts Renderer::lastDraw() const { return impl_->counts; }
unsigned Renderer::depth() const { return impl_->fine.depth(); }

}  // namespace windfall::render
