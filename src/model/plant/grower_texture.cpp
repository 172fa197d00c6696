#include <algorithm>
#include <cmath>

#include "kernels/random.h"
#include "model/plant/grower_private.h"

namespace windfall::model::grower {

float tileNoise(quint64 seed, float x, float y, int width, int height) {
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

float tilePlates(quint64 seed, float x, float y, int width, int height) {
  const int cx = static_cast<int>(std::floor(x)), cy = static_cast<int>(std::floor(y));
  float nearest = 9, second = 9;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const int ix = cx + dx, iy = cy + dy;
      const auto wx = static_cast<std::uint32_t>((ix % width + width) % width);
      const auto wy = static_cast<std::uint32_t>((iy % height + height) % height);
      const float px = static_cast<float>(ix) + 0.15f + 0.7f * uniform(seed, wx, wy, 1);
      const float py = static_cast<float>(iy) + 0.05f + 0.9f * uniform(seed, wx, wy, 2);
      const float distance = std::sqrt((px - x) * (px - x) + (py - y) * (py - y));
      if (distance < nearest) {
        second = nearest, nearest = distance;
      } else {
        second = std::min(second, distance);
      }
    }
  }
  return second - nearest;
}

QImage barkTexture(quint64 seed) {
  constexpr int kWidth = 256, kHeight = 512;
  QImage image(kWidth, kHeight, QImage::Format_RGBA8888);
  for (int y = 0; y < kHeight; ++y) {
    uchar* row = image.scanLine(y);
    for (int x = 0; x < kWidth; ++x) {
      const float u = static_cast<float>(x) / kWidth, v = static_cast<float>(y) / kHeight;
      // Long plates with ragged borders, fine fissures inside them, lichen and grain on top.
      const float bendX =
          0.035f * tileNoise(seed, u * 6, v * 10, 6, 10) + 0.012f * tileNoise(seed + 7, u * 20, v * 32, 20, 32);
      const float bendY = 0.03f * tileNoise(seed + 8, u * 8, v * 12, 8, 12);
      const float border = tilePlates(seed + 1, (u + bendX) * 13, (v + bendY) * 5, 13, 5);
      const float fine = tilePlates(seed + 2, (u + bendX) * 31, (v + bendY) * 9, 31, 9);
      const float plate = std::sqrt(std::clamp(border / 0.42f, 0.0f, 1.0f));
      const float split = 0.72f + 0.28f * std::clamp(fine / 0.3f, 0.0f, 1.0f);
      const float grain = 0.6f * tileNoise(seed + 4, (u + bendX) * 70, v * 40, 70, 40) +
                          0.4f * tileNoise(seed + 5, u * 128, v * 256, 128, 256);
      const float tone = 0.5f + 0.5f * tileNoise(seed + 9, u * 4, v * 6, 4, 6);
      const float lichen = std::clamp(tileNoise(seed + 6, u * 7, v * 13, 7, 13) * 1.6f - 0.5f, 0.0f, 1.0f);
      const float height = std::clamp(plate * split + 0.07f * grain, 0.0f, 1.0f);
      const vec3 deep(58, 49, 41), raised(126, 112, 96), light(148, 138, 124), pale(146, 152, 128);
      const vec3 top = raised + (light - raised) * tone;
      vec3 color = deep + (top - deep) * height;
      color += (pale - color) * (0.4f * lichen * plate);
      color *= 1 + 0.07f * grain;
      for (int k = 0; k < 3; ++k) row[4 * x + k] = static_cast<uchar>(std::clamp(color[k], 0.0f, 255.0f));
      row[4 * x + 3] = 255;
    }
  }
  return image;
}

}  // namespace windfall::model::grower
