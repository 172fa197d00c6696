#include "model/plant/bark.h"

#include <QMutex>
#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "kernels/random.h"

namespace windfall::model {

namespace {

/// Smooth value noise -1..1 over cells that repeat after `columns` and `rows`.
float noise(quint64 seed, float u, float v, int columns, int rows) {
  const float x = u * static_cast<float>(columns), y = v * static_cast<float>(rows);
  const float fx = std::floor(x), fy = std::floor(y);
  const auto value = [&](int dx, int dy) {
    const int cx = ((static_cast<int>(fx) + dx) % columns + columns) % columns;
    const int cy = ((static_cast<int>(fy) + dy) % rows + rows) % rows;
    return 2 * uniform(seed, static_cast<std::uint32_t>(cx), static_cast<std::uint32_t>(cy),
                       static_cast<std::uint32_t>(columns)) -
           1;
  };
  const auto smooth = [](float t) { return t * t * t * (t * (t * 6 - 15) + 10); };
  const float a = smooth(x - fx), b = smooth(y - fy);
  return (value(0, 0) * (1 - a) + value(1, 0) * a) * (1 - b) + (value(0, 1) * (1 - a) + value(1, 1) * a) * b;
}

/// What is near a place among scattered points (Worley 1996) that repeat.
struct Cell {
  float border = 0;  ///< distance to the second minus that to the nearest, in cells
  float nearest = 0;
  std::uint32_t id = 0;
};

Cell cell(quint64 seed, float u, float v, int columns, int rows, float scatter) {
  const float x = u * static_cast<float>(columns), y = v * static_cast<float>(rows);
  const int cx = static_cast<int>(std::floor(x)), cy = static_cast<int>(std::floor(y));
  Cell result{0, 9, 0};
  float second = 9;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const int ix = cx + dx, iy = cy + dy;
      const auto wx = static_cast<std::uint32_t>((ix % columns + columns) % columns);
      const auto wy = static_cast<std::uint32_t>((iy % rows + rows) % rows);
      const float px = static_cast<float>(ix) + 0.5f + scatter * (uniform(seed, wx, wy, 1) - 0.5f);
      const float py = static_cast<float>(iy) + 0.5f + scatter * (uniform(seed, wx, wy, 2) - 0.5f);
      const float distance = std::hypot(px - x, py - y);
      if (distance < result.nearest) {
        second = result.nearest;
        result.nearest = distance, result.id = hash(seed, wx, wy, 3);
      } else {
        second = std::min(second, distance);
      }
    }
  }
  result.border = second - result.nearest;
  return result;
}

float step(float low, float high, float x) {
  const float t = std::clamp((x - low) / (high - low), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

vec3 mixed(vec3 a, vec3 b, float t) { return a + (b - a) * std::clamp(t, 0.0f, 1.0f); }

/// Height 0..1 and colour 0..255 of a place of the tile.
struct Texel {
  float height = 0;
  vec3 colour{0};
};

Texel oak(quint64 seed, float u, float v) {
  const float bend = 0.05f * noise(seed, u, v, 4, 6) + 0.02f * noise(seed + 1, u, v, 11, 17);
  const float lift = 0.05f * noise(seed + 2, u, v, 5, 5);
  const Cell ridge = cell(seed + 3, u + bend, v + lift, 9, 3, 0.9f);
  const Cell chip = cell(seed + 4, u + 1.6f * bend, v + lift, 20, 11, 0.9f);
  const float grain = 0.6f * noise(seed + 5, u + bend, v, 60, 22) + 0.4f * noise(seed + 6, u, v, 128, 96);
  const float plate = std::pow(step(0.02f, 0.42f, ridge.border), 0.7f);
  Texel t;
  t.height = std::clamp(plate * (0.72f + 0.28f * step(0.0f, 0.2f, chip.border)) + 0.06f * grain, 0.0f, 1.0f);
  const float moss = std::clamp(1.5f * noise(seed + 7, u, v, 5, 7) - 0.55f, 0.0f, 1.0f);
  t.colour =
      mixed({46, 37, 30}, mixed({112, 97, 82}, {140, 128, 112}, 0.5f + 0.5f * noise(seed + 8, u, v, 6, 9)), t.height);
  t.colour = mixed(t.colour, {108, 116, 84}, 0.35f * moss * plate) * (1 + 0.08f * grain);
  return t;
}

Texel birch(quint64 seed, float u, float v) {
  const float grain = 0.5f * noise(seed, u, v, 24, 90) + 0.5f * noise(seed + 1, u, v, 90, 128);
  Texel t;
  t.height = 0.62f + 0.05f * grain + 0.05f * noise(seed + 2, u, v, 3, 14);
  t.colour = mixed({226, 220, 210}, {205, 190, 172}, 0.5f + 0.6f * noise(seed + 3, u, v, 4, 9));
  t.colour *= 1 + 0.035f * grain;
  // Lenticels: short dark dashes across the stem, in rows of no order.
  const Cell dash = cell(seed + 4, u + 0.02f * noise(seed + 5, u, v, 7, 11), v, 5, 26, 0.9f);
  const float length = 0.18f + 0.30f * uniform(dash.id);
  const float mark = step(length, length * 0.55f, dash.nearest) * step(0.35f, 0.5f, uniform(dash.id * 747796405u + 1u));
  const float line = mark * step(0.30f, 0.75f, 0.5f + 0.5f * noise(seed + 6, u, v, 9, 120));
  t.colour = mixed(t.colour, {62, 52, 46}, 0.85f * line);
  t.height -= 0.18f * line;
  // Black scars where branches were, ragged and rare.
  const Cell scar =
      cell(seed + 7, u + 0.05f * noise(seed + 8, u, v, 6, 6), v + 0.03f * noise(seed + 9, u, v, 9, 9), 2, 3, 0.8f);
  const float edge = 0.17f + 0.07f * noise(seed + 10, u, v, 22, 22);
  const float black = step(edge + 0.05f, edge - 0.03f, scar.nearest) * (uniform(scar.id) > 0.45f ? 1.0f : 0.0f);
  t.colour = mixed(t.colour, {38, 33, 30}, 0.92f * black);
  t.height += black * (0.25f * noise(seed + 11, u, v, 24, 40) - 0.05f);
  // Paper that peels: thin warm edges along rows.
  const float peel = step(0.86f, 0.95f, 0.5f + 0.5f * noise(seed + 12, u, v, 3, 22));
  t.colour = mixed(t.colour, {196, 150, 116}, 0.5f * peel);
  t.height = std::clamp(t.height + 0.08f * peel, 0.0f, 1.0f);
  return t;
}

Texel beech(quint64 seed, float u, float v) {
  const float grain = 0.5f * noise(seed, u, v, 40, 40) + 0.5f * noise(seed + 1, u, v, 110, 110);
  const float band = noise(seed + 2, u, v, 3, 18);
  const float patch = noise(seed + 3, u, v, 5, 6) + 0.5f * noise(seed + 4, u, v, 12, 14);
  Texel t;
  t.height = std::clamp(0.5f + 0.06f * band + 0.05f * grain + 0.05f * patch, 0.0f, 1.0f);
  t.colour = mixed({128, 128, 122}, {158, 158, 152}, 0.5f + 0.4f * patch) * (1 + 0.04f * grain + 0.03f * band);
  const float lichen = step(0.35f, 0.75f, noise(seed + 5, u, v, 7, 9));
  t.colour = mixed(t.colour, {168, 176, 160}, 0.4f * lichen);
  const float wrinkle = step(0.80f, 0.95f, 0.5f + 0.5f * noise(seed + 6, u, v, 4, 36));
  t.colour *= 1 - 0.16f * wrinkle;
  t.height -= 0.14f * wrinkle;
  return t;
}

Texel pine(quint64 seed, float u, float v) {
  const float bend = 0.03f * noise(seed, u, v, 7, 9), lift = 0.03f * noise(seed + 1, u, v, 8, 8);
  const Cell plate = cell(seed + 2, u + bend, v + lift, 6, 4, 0.85f);
  const Cell flake = cell(seed + 3, u + 2 * bend, v + 2 * lift, 17, 20, 0.9f);
  const float grain = 0.6f * noise(seed + 4, u, v, 50, 70) + 0.4f * noise(seed + 5, u, v, 128, 128);
  const float raised = step(0.03f, 0.20f, plate.border);
  // Each flake lies a little higher or lower than its neighbours.
  const float layer = 0.16f * (uniform(flake.id) - 0.5f) + 0.06f * step(0.0f, 0.12f, flake.border);
  Texel t;
  t.height = std::clamp(raised * (0.78f + layer) + 0.05f * grain, 0.0f, 1.0f);
  const vec3 warm = mixed({139, 92, 66}, {170, 124, 94}, uniform(plate.id));
  t.colour = mixed({50, 34, 28}, mixed(warm, {150, 132, 118}, 0.35f * uniform(flake.id ^ 77u)), t.height);
  t.colour *= 1 + 0.09f * grain + 0.10f * (uniform(flake.id) - 0.5f) * raised;
  return t;
}

Texel maple(quint64 seed, float u, float v) {
  const float bend = 0.03f * noise(seed, u, v, 5, 4), grain = noise(seed + 1, u, v, 90, 60);
  const Cell strip = cell(seed + 2, u + bend, v, 14, 2, 0.9f);
  const Cell flake = cell(seed + 3, u + bend, v, 26, 9, 0.9f);
  const float ridge = step(0.0f, 0.35f, strip.border);
  Texel t;
  t.height = std::clamp(0.25f + 0.5f * ridge + 0.14f * step(0.0f, 0.15f, flake.border) + 0.05f * grain, 0.0f, 1.0f);
  t.colour =
      mixed({74, 66, 58}, mixed({124, 114, 103}, {146, 138, 126}, uniform(strip.id)), t.height) * (1 + 0.07f * grain);
  return t;
}

Texel herb(quint64 seed, float u, float v) {
  const float rib = std::cos(6.2831853f * 8 * (u + 0.01f * noise(seed, u, v, 4, 4)));
  const float grain = 0.6f * noise(seed + 1, u, v, 80, 20) + 0.4f * noise(seed + 2, u, v, 100, 128);
  Texel t;
  t.height = std::clamp(0.5f + 0.16f * rib + 0.06f * grain, 0.0f, 1.0f);
  t.colour =
      mixed({74, 98, 42}, {112, 134, 66}, 0.5f + 0.3f * rib + 0.2f * noise(seed + 3, u, v, 6, 6)) * (1 + 0.06f * grain);
  return t;
}

Texel texel(BarkKind kind, quint64 seed, float u, float v) {
  switch (kind) {
    case BarkKind::Birch:
      return birch(seed, u, v);
    case BarkKind::Beech:
      return beech(seed, u, v);
    case BarkKind::Pine:
      return pine(seed, u, v);
    case BarkKind::Maple:
      return maple(seed, u, v);
    case BarkKind::Herb:
      return herb(seed, u, v);
    case BarkKind::Oak:
      break;
  }
  return oak(seed, u, v);
}

/// Height of the relief, in widths of the tile.
float reliefOf(BarkKind kind) {
  switch (kind) {
    case BarkKind::Oak:
      return 0.06f;
    case BarkKind::Pine:
      return 0.05f;
    case BarkKind::Maple:
      return 0.035f;
    case BarkKind::Birch:
    case BarkKind::Beech:
      return 0.02f;
    case BarkKind::Herb:
      break;
  }
  return 0.015f;
}

BarkTile makeTile(BarkKind kind, quint64 seed, int size) {
  BarkTile tile{QImage(size, size, QImage::Format_RGBA8888), QImage(size, size, QImage::Format_RGBA8888)};
  std::vector<float> heights(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
  const auto side = static_cast<float>(size);
  const auto at = [size](int x, int y) {
    const int wx = (x % size + size) % size, wy = (y % size + size) % size;
    return static_cast<std::size_t>(wy) * static_cast<std::size_t>(size) + static_cast<std::size_t>(wx);
  };
  uchar* const colours = tile.colour.bits();
  uchar* const normals = tile.normals.bits();
#pragma omp parallel for schedule(static)
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const Texel t = texel(kind, seed, (static_cast<float>(x) + 0.5f) / side, (static_cast<float>(y) + 0.5f) / side);
      heights[at(x, y)] = t.height;
      uchar* const out = colours + 4 * at(x, y);
      for (int k = 0; k < 3; ++k) out[k] = static_cast<uchar>(std::clamp(t.colour[k], 0.0f, 255.0f));
      out[3] = 255;
    }
  }
  const float scale = 0.5f * reliefOf(kind) * side;
#pragma omp parallel for schedule(static)
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const float dx = (heights[at(x + 1, y)] - heights[at(x - 1, y)]) * scale;
      const float dy = (heights[at(x, y - 1)] - heights[at(x, y + 1)]) * scale;  // up the picture
      const vec3 n = glm::normalize(vec3(-dx, -dy, 1));
      uchar* const out = normals + 4 * at(x, y);
      for (int k = 0; k < 3; ++k) out[k] = static_cast<uchar>(std::lround(127.5f + 127.5f * n[k]));
      out[3] = 255;
    }
  }
  return tile;
}

}  // namespace

BarkTile barkTile(BarkKind kind, quint64 seed, int size) {
  static QMutex mutex;
  static std::map<std::tuple<BarkKind, quint64, int>, BarkTile> made;
  const QMutexLocker lock(&mutex);
  auto [tile, isNew] = made.try_emplace({kind, seed, size});
  if (isNew) tile->second = makeTile(kind, seed, size);
  return tile->second;
}

Material barkMaterial(BarkKind kind) {
  const BarkTile tile = barkTile(kind);
  Material bark;
  bark.name = QStringLiteral("bark");
  bark.baseColor = vec4(1);
  bark.texture = tile.colour;
  bark.normalMap = tile.normals;
  bark.roughness = kind == BarkKind::Beech || kind == BarkKind::Birch ? 0.75f : 0.9f;
  return bark;
}

}  // namespace windfall::model
