#include "model/plant/grow/species_bark.h"

#include <algorithm>
#include <cmath>

#include "kernels/random.h"
#include "model/plant/grower_private.h"

namespace windfall::model::growth {

namespace {

using grower::tileNoise;
using grower::tilePlates;

constexpr int kWidth = 256, kHeight = 512;

float step(float low, float high, float x) {
  const float t = std::clamp((x - low) / (high - low), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}
vec3 blend(vec3 a, vec3 b, float t) { return a + (b - a) * t; }

/// Furrowed bark: plates of `across` by `along` a tile between dark fissures.
vec3 furrowed(quint64 seed, float u, float v, int across, int along, vec3 deep, vec3 raised, vec3 light, float depth) {
  const float bendX =
      0.03f * tileNoise(seed, u * 6, v * 10, 6, 10) + 0.012f * tileNoise(seed + 7, u * 20, v * 32, 20, 32);
  const float bendY = 0.03f * tileNoise(seed + 8, u * 8, v * 12, 8, 12);
  const float border = tilePlates(seed + 1, (u + bendX) * static_cast<float>(across),
                                  (v + bendY) * static_cast<float>(along), across, along);
  const float fine = tilePlates(seed + 2, (u + bendX) * 31, (v + bendY) * 9, 31, 9);
  const float plate = step(0.0f, depth, border);
  const float grain =
      0.6f * tileNoise(seed + 4, u * 70, v * 40, 70, 40) + 0.4f * tileNoise(seed + 5, u * 128, v * 256, 128, 256);
  const float tone = 0.5f + 0.5f * tileNoise(seed + 9, u * 4, v * 6, 4, 6);
  const float height = std::clamp(plate * (0.75f + 0.25f * std::min(fine / 0.3f, 1.0f)) + 0.06f * grain, 0.0f, 1.0f);
  return blend(deep, blend(raised, light, tone), height) * (1 + 0.07f * grain);
}

/// Short marks lying across the stem, `rows` by `columns` of them a tile: 0 none, 1 full.
float lenticels(quint64 seed, float u, float v, int columns, int rows, float share, float thick) {
  float most = 0;
  const float x = u * static_cast<float>(columns), y = v * static_cast<float>(rows);
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const int ix = static_cast<int>(std::floor(x)) + dx, iy = static_cast<int>(std::floor(y)) + dy;
      const auto wx = static_cast<std::uint32_t>((ix % columns + columns) % columns),
                 wy = static_cast<std::uint32_t>((iy % rows + rows) % rows);
      if (uniform(seed, wx, wy, 5) > share) continue;
      const float px = static_cast<float>(ix) + 0.2f + 0.6f * uniform(seed, wx, wy, 1),
                  py = static_cast<float>(iy) + 0.2f + 0.6f * uniform(seed, wx, wy, 2);
      const float length = 0.25f + 0.45f * uniform(seed, wx, wy, 3);
      const float d = std::hypot((x - px) / length, (y - py) / (thick * (0.6f + 0.8f * uniform(seed, wx, wy, 4))));
      most = std::max(most, 1 - step(0.6f, 1.0f, d));
    }
  }
  return most;
}

vec3 birch(quint64 seed, float u, float v) {
  const float cloud = tileNoise(seed, u * 4, v * 7, 4, 7), fine = tileNoise(seed + 1, u * 40, v * 20, 40, 20);
  vec3 colour = blend(vec3(226, 221, 211), vec3(244, 241, 235), 0.5f + 0.5f * cloud) * (1 + 0.03f * fine);
  colour = blend(colour, vec3(214, 186, 160), 0.35f * step(0.35f, 0.8f, tileNoise(seed + 2, u * 3, v * 5, 3, 5)));
  // Peeling curls: faint lines around the stem.
  const float curl = tileNoise(seed + 3, u * 3, v * 60, 3, 60);
  colour *= 1 - 0.10f * step(0.55f, 0.8f, curl);
  colour = blend(colour, vec3(58, 50, 46), 0.85f * lenticels(seed + 4, u, v, 5, 34, 0.42f, 0.16f));
  // Black rough patches where branches were.
  const float wave = 0.25f * tileNoise(seed + 6, u * 16, v * 24, 16, 24);
  return blend(colour, vec3(40, 36, 34),
               0.95f * lenticels(seed + 5, u + 0.04f * wave, v + 0.03f * wave, 2, 5, 0.45f, 0.30f));
}

vec3 aspen(quint64 seed, float u, float v) {
  const float cloud = tileNoise(seed, u * 5, v * 6, 5, 6), fine = tileNoise(seed + 1, u * 60, v * 60, 60, 60);
  vec3 colour = blend(vec3(168, 174, 148), vec3(205, 206, 184), 0.5f + 0.5f * cloud) * (1 + 0.04f * fine);
  colour = blend(colour, vec3(120, 124, 104), 0.3f * step(0.3f, 0.8f, tileNoise(seed + 2, u * 3, v * 9, 3, 9)));
  colour = blend(colour, vec3(60, 58, 50), 0.8f * lenticels(seed + 3, u, v, 9, 26, 0.18f, 0.24f));
  return blend(colour, vec3(46, 44, 38), 0.95f * lenticels(seed + 4, u, v, 2, 4, 0.35f, 0.20f));
}

vec3 smooth(quint64 seed, float u, float v, vec3 dark, vec3 light, vec3 mark, float marks) {
  const float cloud = 0.6f * tileNoise(seed, u * 5, v * 8, 5, 8) + 0.4f * tileNoise(seed + 1, u * 16, v * 22, 16, 22);
  const float fine = tileNoise(seed + 2, u * 90, v * 60, 90, 60);
  vec3 colour = blend(dark, light, 0.5f + 0.5f * cloud) * (1 + 0.06f * fine);
  const float crack = tileNoise(seed + 5, u * 6, v * 40, 6, 40);
  colour *= 1 - 0.18f * step(0.5f, 0.85f, crack);
  return blend(colour, mark, 0.7f * lenticels(seed + 3, u, v, 14, 40, marks, 0.35f));
}

vec3 weathered(quint64 seed, float u, float v) {
  const float grain = tileNoise(seed, u * 40, v * 5, 40, 5), fine = tileNoise(seed + 1, u * 120, v * 16, 120, 16);
  const float cloud = tileNoise(seed + 2, u * 4, v * 5, 4, 5);
  vec3 colour =
      blend(vec3(132, 126, 118), vec3(186, 181, 172), 0.5f + 0.35f * cloud + 0.15f * grain) * (1 + 0.08f * fine);
  const float crack = tilePlates(seed + 3, (u + 0.03f * tileNoise(seed + 4, u * 6, v * 8, 6, 8)) * 9, v * 2, 9, 2);
  return blend(vec3(52, 47, 43), colour, step(0.0f, 0.10f, crack));
}

vec3 colourAt(BarkLook look, quint64 s, float u, float v) {
  switch (look) {
    case BarkLook::Oak:
      return furrowed(s, u, v, 10, 4, {44, 38, 32}, {104, 95, 82}, {132, 124, 110}, 0.42f);
    case BarkLook::Birch:
      return birch(s, u, v);
    case BarkLook::Aspen:
      return aspen(s, u, v);
    case BarkLook::Willow:
      return furrowed(s, u, v, 8, 3, {52, 42, 31}, {124, 106, 82}, {150, 133, 106}, 0.38f);
    case BarkLook::Maple:
      return furrowed(s, u, v, 15, 6, {72, 66, 60}, {122, 115, 106}, {148, 142, 132}, 0.24f);
    case BarkLook::Fir:
      return smooth(s, u, v, {92, 84, 76}, {128, 121, 112}, {70, 62, 54}, 0.25f);
    case BarkLook::Pine:
      return furrowed(s, u, v, 6, 5, {50, 36, 28}, {138, 92, 66}, {164, 116, 86}, 0.30f);
    case BarkLook::Bush:
      return smooth(s, u, v, {86, 62, 48}, {116, 88, 68}, {156, 134, 110}, 0.30f);
    case BarkLook::Herb:
      return smooth(s, u, v, {84, 118, 52}, {120, 152, 74}, {96, 130, 62}, 0.0f);
    case BarkLook::Dead:
      return weathered(s, u, v);
    default:
      return {};
  }
}

}  // namespace

QImage speciesBark(BarkLook look, quint64 seed) {
  if (look == BarkLook::Plain) return grower::barkTexture(seed);
  QImage image(kWidth, kHeight, QImage::Format_RGBA8888);
#pragma omp parallel for schedule(static)
  for (int y = 0; y < kHeight; ++y) {
    // One row is one thread's own; scanLine would detach.
    uchar* row = const_cast<uchar*>(image.constScanLine(y));
    for (int x = 0; x < kWidth; ++x) {
      const vec3 colour = colourAt(look, seed, static_cast<float>(x) / kWidth, static_cast<float>(y) / kHeight);
      for (int k = 0; k < 3; ++k) row[4 * x + k] = static_cast<uchar>(std::clamp(colour[k], 0.0f, 255.0f));
      row[4 * x + 3] = 255;
    }
  }
  return image;
}

TwigLook twigLook(BarkLook look) {
  switch (look) {
    case BarkLook::Oak:
      return {{0.115f, 0.095f, 0.075f, 1}, 0.010f};
    case BarkLook::Birch:
      return {{0.085f, 0.045f, 0.035f, 1}, 0.011f};
    case BarkLook::Aspen:
      return {{0.22f, 0.19f, 0.13f, 1}, 0.006f};
    case BarkLook::Willow:
      return {{0.30f, 0.24f, 0.06f, 1}, 0.009f};
    case BarkLook::Maple:
      return {{0.16f, 0.10f, 0.075f, 1}, 0.008f};
    case BarkLook::Fir:
      return {{0.12f, 0.085f, 0.055f, 1}, 0.006f};
    case BarkLook::Pine:
      return {{0.24f, 0.115f, 0.055f, 1}, 0.016f};
    case BarkLook::Bush:
      return {{0.15f, 0.07f, 0.045f, 1}, 0.005f};
    case BarkLook::Herb:
      return {{0.13f, 0.22f, 0.06f, 1}, 0.002f};
    case BarkLook::Dead:
      return {{0.33f, 0.31f, 0.28f, 1}, 0.006f};
    default:
      return {};
  }
}

}  // namespace windfall::model::growth
