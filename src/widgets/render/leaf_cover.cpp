#include "widgets/render/leaf_cover.h"

#include <algorithm>
#include <cmath>

namespace windfall::render {

namespace {

constexpr float kShape = 0.72f, kShare = 0.55f;  // MipLevel::decided: alpha is a shape, alpha is a share
constexpr int kSteps = 8;                        // samples along a triangle's sides
constexpr float kMostFactor = 64;

float alphaAt(const MipLevel& level, vec2 uv) {
  const float x = uv.x * static_cast<float>(level.width) - 0.5f, y = uv.y * static_cast<float>(level.height) - 0.5f;
  const auto texel = [&](int px, int py) {
    px = std::clamp(px, 0, level.width - 1);
    py = std::clamp(py, 0, level.height - 1);
    const auto at = static_cast<std::size_t>(py) * static_cast<std::size_t>(level.width) + static_cast<std::size_t>(px);
    return static_cast<float>(level.rgba[at * 4 + 3]) / 255;
  };
  const float fx = std::floor(x), fy = std::floor(y);
  const int px = static_cast<int>(fx), py = static_cast<int>(fy);
  const float u = x - fx, v = y - fy;
  return (texel(px, py) * (1 - u) + texel(px + 1, py) * u) * (1 - v) +
         (texel(px, py + 1) * (1 - u) + texel(px + 1, py + 1) * u) * v;
}

/// A place in a shape and the share of the picture that it stands for.
struct Sample {
  vec2 uv;
  float area;
};

std::vector<Sample> samplesOf(const LeafShape& shape) {
  std::vector<Sample> samples;
  for (std::size_t i = 0; i + 2 < shape.indices.size(); i += 3) {
    const vec2 a = shape.corners[shape.indices[i]].uv, b = shape.corners[shape.indices[i + 1]].uv - a,
               c = shape.corners[shape.indices[i + 2]].uv - a;
    const float area = 0.5f * std::abs(b.x * c.y - b.y * c.x) / (kSteps * kSteps);
    for (int y = 0; y < kSteps; ++y) {
      // Middles of the small triangles that the sides' steps make.
      for (int x = 0; x < 2 * (kSteps - y) - 1; ++x) {
        const float third = (x & 1) != 0 ? 2.0f / 3 : 1.0f / 3;
        samples.push_back(
            {a + b * ((static_cast<float>(x / 2) + third) / kSteps) + c * ((static_cast<float>(y) + third) / kSteps),
             area});
      }
    }
  }
  return samples;
}

float factorOf(const MipLevel& level, const std::vector<Sample>& samples, float wanted) {
  std::vector<float> alphas;
  alphas.reserve(samples.size());
  for (const Sample& sample : samples) alphas.push_back(alphaAt(level, sample.uv));
  float factor = 1;
  // What is more than covered counts no more than that.
  for (int round = 0; round < 4; ++round) {
    double covered = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      covered += static_cast<double>(std::min(1.0f, alphas[i] * factor) * samples[i].area);
    }
    if (!(covered > 1e-7)) return 1;
    factor = std::clamp(factor * wanted / static_cast<float>(covered), 0.25f, kMostFactor);
  }
  return factor;
}

/// The level at which `decided` falls to a value.
float levelWhere(const std::vector<MipLevel>& levels, float decided) {
  for (std::size_t i = 1; i < levels.size(); ++i) {
    const float before = levels[i - 1].decided, now = levels[i].decided;
    if (now > decided) continue;
    if (before <= decided) return static_cast<float>(i - 1);
    return static_cast<float>(i - 1) + (before - decided) / std::max(before - now, 1e-6f);
  }
  return static_cast<float>(levels.size());
}

}  // namespace

LeafCover coverOf(const std::vector<MipLevel>& levels, const std::array<LeafShape, kLeafLevels>& shapes) {
  LeafCover cover;
  cover.factors.fill(vec4(1));
  if (levels.empty()) return cover;
  cover.from = levelWhere(levels, kShape);
  cover.to = std::max(levelWhere(levels, kShare), cover.from + 0.5f);
  const auto wanted = static_cast<float>(coverage(levels.front()));
  for (std::size_t s = 0; s < kLeafLevels; ++s) {
    const std::vector<Sample> samples = samplesOf(shapes[s]);
    if (samples.empty() || !(wanted > 0)) continue;
    for (std::size_t i = 0; i < kCoverLevels; ++i) {
      const std::size_t level = std::min(i, levels.size() - 1);
      cover.factors[i][static_cast<int>(s)] =
          i > level ? cover.factors[i - 1][static_cast<int>(s)] : factorOf(levels[level], samples, wanted);
    }
  }
  return cover;
}

vec4 meanOver(const Picture& map, const Picture& leaf, const vec4& plain) {
  if (map.rgba.empty() || leaf.rgba.empty()) return plain;
  double sum[4]{}, weights = 0;
  for (int y = 0; y < map.height; ++y) {
    const int ly = static_cast<int>((static_cast<std::int64_t>(y) * 2 + 1) * leaf.height / (2 * map.height));
    for (int x = 0; x < map.width; ++x) {
      const int lx = static_cast<int>((static_cast<std::int64_t>(x) * 2 + 1) * leaf.width / (2 * map.width));
      const auto at = [](const Picture& p, int px, int py) {
        return (static_cast<std::size_t>(py) * static_cast<std::size_t>(p.width) + static_cast<std::size_t>(px)) * 4;
      };
      const double weight = leaf.rgba[at(leaf, lx, ly) + 3];
      const std::size_t from = at(map, x, y);
      for (std::size_t c = 0; c < 4; ++c) sum[c] += weight * map.rgba[from + c];
      weights += weight;
    }
  }
  if (!(weights > 0)) return plain;
  return vec4(sum[0], sum[1], sum[2], sum[3]) / static_cast<float>(weights * 255);
}

}  // namespace windfall::render
