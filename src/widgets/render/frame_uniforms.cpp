#include "widgets/render/frame_uniforms.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace windfall::render {

namespace {

constexpr float kNear = 0.05f;     // m
constexpr float kExposure = 1.2f;  // of a clear day, in the sky model's units
const vec3 kAccent(0.05f, 0.42f, 0.95f);

}  // namespace

FrameUniforms frameUniforms(const View& view, const SkyLight& sky, const ShadowFit& shadow) {
  FrameUniforms out{};
  vec3 forward = view.target - view.eye;
  forward = glm::length(forward) > 1e-6f ? glm::normalize(forward) : vec3(0, 0, -1);
  const vec3 above = std::abs(forward.y) > 0.9999f ? vec3(0, 0, -1) : vec3(0, 1, 0);
  const vec3 right = glm::normalize(glm::cross(forward, above)), up = glm::cross(right, forward);
  const float tangent = view.tangent();
  const float aspect = static_cast<float>(view.width) / static_cast<float>(std::max(1, view.height));
  // clip = (x / (tan aspect), y / tan, near, -z): depth near / distance.
  mat4& m = out.viewProjection;
  const vec3 rows[4] = {right / (tangent * aspect), up / tangent, vec3(0), forward};
  for (int column = 0; column < 3; ++column) {
    m[column] = vec4(rows[0][column], rows[1][column], rows[2][column], rows[3][column]);
  }
  m[3] = vec4(-glm::dot(rows[0], view.eye), -glm::dot(rows[1], view.eye), kNear, -glm::dot(forward, view.eye));

  out.shadowMatrix = shadow.toTexture;
  out.eye = vec4(view.eye, view.time);
  out.toSun = vec4(glm::normalize(view.toSun), kExposure * std::exp2(view.exposure));
  out.sunColor = vec4(sky.sun * view.sunStrength, shadow.texel);
  for (std::size_t i = 0; i < 4; ++i) out.ambient[i] = vec4(sky.ambient[i], 0);
  out.forward = vec4(forward, 0);
  out.right = vec4(right * tangent * aspect, 0);
  out.up = vec4(up * tangent, 0);
  out.wind = vec4(view.wind, 0);
  out.viewport = vec4(view.width, view.height, 1.f / static_cast<float>(std::max(1, view.width)),
                      1.f / static_cast<float>(std::max(1, view.height)));
  out.accent = vec4(kAccent, view.highlighted.empty() ? 0.f : 0.75f);
  return out;
}

void setCanopies(FrameUniforms& uniforms, const std::vector<Canopy>& canopies) {
  const std::size_t count = std::min<std::size_t>(canopies.size(), FrameUniforms::kCanopies);
  for (std::size_t i = 0; i < count; ++i) {
    uniforms.canopies[2 * i] = vec4(canopies[i].center, 1);
    uniforms.canopies[2 * i + 1] = vec4(canopies[i].radius, canopies[i].halfHeight, 0, 0);
  }
  uniforms.wind.w = static_cast<float>(count);
}

}  // namespace windfall::render
