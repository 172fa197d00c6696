#include "widgets/render/noise_texture.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "kernels/random.h"
#include "widgets/render/gl_version.h"

namespace windfall::render {

namespace {

constexpr int kSize = 512;

/// Adds Perlin's gradient noise of `waves` cells a tile, about -0.7..0.7 times `amplitude`, periodic.
void addNoise(std::vector<float>& field, std::uint32_t waves, std::uint32_t seed, float amplitude) {
  std::vector<vec2> gradients;
  for (std::uint32_t i = 0; i < waves * waves; ++i) {
    const float angle = 6.2831853f * uniform(seed, i % waves, i / waves);
    gradients.emplace_back(std::cos(angle), std::sin(angle));
  }
  const auto fade = [](float t) { return t * t * t * (t * (t * 6 - 15) + 10); };
  std::size_t at = 0;
  for (int y = 0; y < kSize; ++y) {
    const float py = (static_cast<float>(y) + 0.5f) / kSize * static_cast<float>(waves);
    const auto iy = static_cast<std::uint32_t>(py);
    const float fy = py - static_cast<float>(iy), v = fade(fy);
    for (int x = 0; x < kSize; ++x) {
      const float px = (static_cast<float>(x) + 0.5f) / kSize * static_cast<float>(waves);
      const auto ix = static_cast<std::uint32_t>(px);
      const float fx = px - static_cast<float>(ix), u = fade(fx);
      const auto corner = [&](std::uint32_t cx, std::uint32_t cy) {
        const vec2 g = gradients[(iy + cy) % waves * waves + (ix + cx) % waves];
        return g.x * (fx - static_cast<float>(cx)) + g.y * (fy - static_cast<float>(cy));
      };
      const float low = corner(0, 0) * (1 - u) + corner(1, 0) * u, high = corner(0, 1) * (1 - u) + corner(1, 1) * u;
      field[at++] += amplitude * (low * (1 - v) + high * v);
    }
  }
}

std::vector<float> octaves(std::uint32_t waves, int count, std::uint32_t seed) {
  std::vector<float> field(static_cast<std::size_t>(kSize) * kSize, 0.f);
  float amplitude = 1;
  for (int i = 0; i < count; ++i, amplitude *= 0.55f)
    addNoise(field, waves << i, seed + static_cast<std::uint32_t>(i), amplitude);
  return field;
}

std::uint8_t byte(float value) { return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.f, 1.f) * 255.f)); }

}  // namespace

Texture makeNoiseTexture() {
  const std::vector<float> broad = octaves(4, 5, 11), fine = octaves(32, 3, 23), ridges = octaves(8, 4, 37);
  std::vector<std::uint8_t> texels;
  texels.reserve(broad.size() * 4);
  for (std::size_t i = 0; i < broad.size(); ++i) {
    texels.push_back(byte(0.5f + 0.62f * broad[i]));
    texels.push_back(byte(0.5f + 0.62f * fine[i]));
    texels.push_back(byte(1 - std::abs(ridges[i]) * 2.2f));
    texels.push_back(byte(uniform(91, static_cast<std::uint32_t>(i))));
  }
  Texture texture = makeTexture(GL_TEXTURE_2D);
  glTextureStorage2D(texture.id(), 10, GL_RGBA8, kSize, kSize);
  glTextureSubImage2D(texture.id(), 0, 0, 0, kSize, kSize, GL_RGBA, GL_UNSIGNED_BYTE, texels.data());
  glGenerateTextureMipmap(texture.id());
  glTextureParameteri(texture.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTextureParameteri(texture.id(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  // The ground is seen at a glancing angle. llvmpipe's anisotropic filter takes minutes for a frame.
  if (!isSoftware() && (epoxy_has_gl_extension("GL_ARB_texture_filter_anisotropic") ||
                        epoxy_has_gl_extension("GL_EXT_texture_filter_anisotropic"))) {
    glTextureParameterf(texture.id(), GL_TEXTURE_MAX_ANISOTROPY, 4);
  }
  return texture;
}

}  // namespace windfall::render
