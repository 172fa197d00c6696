#include "widgets/render/shadow_map.h"

#include <cmath>

#include <glm/geometric.hpp>

namespace windfall::render {

namespace {
/// The ground that a low sun throws the shadows on lies far behind what casts them, in radii of the sphere.
constexpr float kBehind = 12;
}  // namespace

ShadowFit fitShadow(const vec3& center, float radius, const vec3& toSun, int size) {
  ShadowFit fit;
  fit.texel = 2 * radius / static_cast<float>(size);
  const vec3 forward = -glm::normalize(toSun);
  const vec3 right = glm::normalize(glm::cross(forward, std::abs(forward.y) > 0.99f ? vec3(0, 0, 1) : vec3(0, 1, 0)));
  const vec3 up = glm::cross(right, forward);
  const auto snapped = [&](float value) { return std::floor(value / fit.texel) * fit.texel; };
  const vec3 middle(snapped(glm::dot(center, right)), snapped(glm::dot(center, up)), glm::dot(center, forward));
  const float depth = (1 + kBehind) * radius;
  const vec3 rows[3] = {right / radius, up / radius, forward / depth};
  const vec3 offset(-middle.x / radius, -middle.y / radius, (radius - middle.z) / depth);
  mat4& m = fit.toClip;
  for (int column = 0; column < 3; ++column) m[column] = vec4(rows[0][column], rows[1][column], rows[2][column], 0);
  m[3] = vec4(offset, 1);
  mat4 half(1);
  half[0][0] = half[1][1] = 0.5f;
  half[3] = vec4(0.5f, 0.5f, 0, 1);
  fit.toTexture = half * m;
  return fit;
}

Status ShadowMap::resize(int size) {
  if (size == size_) return ok();
  clearErrors();
  Texture texture = makeTexture(GL_TEXTURE_2D);
  glTextureStorage2D(texture.id(), 1, GL_DEPTH_COMPONENT32F, size, size);
  if (outOfMemory()) return Error{"not enough graphics memory for the shadows"};
  glTextureParameteri(texture.id(), GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  glTextureParameteri(texture.id(), GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  glTextureParameteri(texture.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTextureParameteri(texture.id(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTextureParameteri(texture.id(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(texture.id(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  Framebuffer framebuffer = makeFramebuffer();
  glNamedFramebufferTexture(framebuffer.id(), GL_DEPTH_ATTACHMENT, texture.id(), 0);
  glNamedFramebufferDrawBuffer(framebuffer.id(), GL_NONE);
  texture_ = std::move(texture);
  framebuffer_ = std::move(framebuffer);
  size_ = size;
  return ok();
}

}  // namespace windfall::render
