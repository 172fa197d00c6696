#include <algorithm>
#include <cmath>

#include "kernels/random.h"
#include "model/plant/grower_private.h"

namespace windfall::model::grower {

namespace {

/// Smooth value noise -1..1 that repeats after `width` by `height` cells.
float noise(quint64 seed, float x, float y, int width, int height) {
  const float fx = std::floor(x), fy = std::floor(y);
  const auto value = [&](int dx, int dy) {
    const int cx = ((static_cast<int>(fx) + dx) % width + width) % width;
    const int cy = ((static_cast<int>(fy) + dy) % height + height) % height;
    return 2 * uniform(seed, static_cast<std::uint32_t>(cx), static_cast<std::uint32_t>(cy),
                       static_cast<std::uint32_t>(width)) -
           1;
  };
  const auto smooth = [](float t) { return t * t * t * (t * (t * 6 - 15) + 10); };
  const float u = smooth(x - fx), v = smooth(y - fy);
  return (value(0, 0) * (1 - u) + value(1, 0) * u) * (1 - v) + (value(0, 1) * (1 - u) + value(1, 1) * u) * v;
}

}  // namespace

QImage barkTexture(quint64 seed) {
  constexpr int kWidth = 256, kHeight = 512;
  QImage image(kWidth, kHeight, QImage::Format_RGBA8888);
  for (int y = 0; y < kHeight; ++y) {
    uchar* row = image.scanLine(y);
    for (int x = 0; x < kWidth; ++x) {
      const float u = static_cast<float>(x) / kWidth, v = static_cast<float>(y) / kHeight;
      // Long ridges that wander sideways, split by fissures and cross-cracks, with lichen and fine grain on top.
      const float bend = 0.055f * noise(seed, u * 3, v * 5, 3, 5) + 0.02f * noise(seed, u * 8, v * 14, 8, 14);
      const float ridge = std::abs(noise(seed + 1, (u + bend) * 11, v * 5, 11, 5)) * 0.65f +
                          std::abs(noise(seed + 2, (u + bend) * 23, v * 12, 23, 12)) * 0.35f;
      const float fissure = std::clamp((ridge - 0.05f) / 0.22f, 0.0f, 1.0f);
      const float crack = std::clamp(std::abs(noise(seed + 3, u * 9, (v + bend) * 30, 9, 30)) / 0.12f, 0.0f, 1.0f);
      const float grain =
          noise(seed + 4, u * 64, v * 96, 64, 96) * 0.5f + noise(seed + 5, u * 128, v * 128, 128, 128) * 0.5f;
      const float lichen = std::clamp(noise(seed + 6, u * 5, v * 9, 5, 9) * 1.6f - 0.35f, 0.0f, 1.0f);
      const float height = fissure * (0.8f + 0.2f * crack) + 0.10f * grain;
      const vec3 deep(48, 39, 32), raised(142, 126, 107), pale(150, 152, 128);
      vec3 color = deep + (raised - deep) * std::clamp(height, 0.0f, 1.0f);
      color += (pale - color) * (0.35f * lichen * fissure);
      color *= 1 + 0.08f * grain;
      for (int k = 0; k < 3; ++k) row[4 * x + k] = static_cast<uchar>(std::clamp(color[k], 0.0f, 255.0f));
      row[4 * x + 3] = 255;
    }
  }
  return image;
}

}  // namespace windfall::model::grower
