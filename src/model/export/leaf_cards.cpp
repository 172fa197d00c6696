#include "model/export/leaf_cards.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "model/leaf/dilate.h"

namespace windfall::model {

namespace {

constexpr int kTile = 64, kGap = 2, kFine = 3;  // px of a picture with its gap, samples along a pixel's side
constexpr int kInner = kTile - 2 * kGap;
constexpr int kSamples = kInner * kFine;

/// Right and up of a picture that looks along the third axis.
struct View {
  vec3 right, up;
};
constexpr std::array<View, 3> kViews{View{{1, 0, 0}, {0, 1, 0}}, View{{0, 0, -1}, {0, 1, 0}},
                                     View{{1, 0, 0}, {0, 0, -1}}};

float linearOf(int byte) {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> values{};
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double s = static_cast<double>(i) / 255;
      values[i] = static_cast<float>(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4));
    }
    return values;
  }();
  return table[static_cast<std::size_t>(byte)];
}

uchar byteOf(float linear) {
  const float s = linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
  return static_cast<uchar>(std::lround(255 * std::clamp(s, 0.0f, 1.0f)));
}

/// A leaf's picture about as coarse as the samples: linear, premultiplied.
struct Small {
  int width = 0, height = 0;
  std::vector<vec4> texels;

  vec4 at(vec2 uv) const {
    const int x = std::clamp(static_cast<int>(uv.x * static_cast<float>(width)), 0, width - 1);
    const int y = std::clamp(static_cast<int>(uv.y * static_cast<float>(height)), 0, height - 1);
    return texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }
};

Small shrunk(const QImage& picture, float wantedHeight) {
  const QImage image = picture.convertToFormat(QImage::Format_RGBA8888);
  const int factor = std::max(1, static_cast<int>(static_cast<float>(image.height()) / std::max(wantedHeight, 4.0f)));
  Small small{std::max(1, image.width() / factor), std::max(1, image.height() / factor), {}};
  small.texels.reserve(static_cast<std::size_t>(small.width) * static_cast<std::size_t>(small.height));
  for (int y = 0; y < small.height; ++y) {
    for (int x = 0; x < small.width; ++x) {
      vec4 sum(0);
      int count = 0;
      for (int py = y * factor; py < std::min(image.height(), (y + 1) * factor); ++py) {
        const uchar* row = image.constScanLine(py);
        for (int px = x * factor; px < std::min(image.width(), (x + 1) * factor); ++px, ++count) {
          const uchar* p = row + 4 * px;
          const float alpha = static_cast<float>(p[3]) / 255;
          sum += vec4(linearOf(p[0]) * alpha, linearOf(p[1]) * alpha, linearOf(p[2]) * alpha, alpha);
        }
      }
      small.texels.push_back(sum / static_cast<float>(std::max(1, count)));
    }
  }
  return small;
}

/// Samples of one picture: what is nearest to its eye.
class Canvas {
 public:
  Canvas() : depth_(kSamples * kSamples, -std::numeric_limits<float>::max()), color_(kSamples * kSamples, vec4(0)) {}

  /// Corners in samples, depth towards the eye.
  void triangle(const std::array<vec3, 3>& p, const std::array<vec2, 3>& uv, const Small& picture) {
    const float area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x);
    if (std::abs(area) < 1e-6f) return;
    const auto low = [](float a, float b, float c) {
      return std::max(0, static_cast<int>(std::floor(std::min({a, b, c}))));
    };
    const auto high = [](float a, float b, float c) {
      return std::min(kSamples - 1, static_cast<int>(std::ceil(std::max({a, b, c}))));
    };
    for (int y = low(p[0].y, p[1].y, p[2].y); y <= high(p[0].y, p[1].y, p[2].y); ++y) {
      for (int x = low(p[0].x, p[1].x, p[2].x); x <= high(p[0].x, p[1].x, p[2].x); ++x) {
        const float px = static_cast<float>(x) + 0.5f, py = static_cast<float>(y) + 0.5f;
        const float b = ((px - p[0].x) * (p[2].y - p[0].y) - (py - p[0].y) * (p[2].x - p[0].x)) / area;
        const float c = ((p[1].x - p[0].x) * (py - p[0].y) - (p[1].y - p[0].y) * (px - p[0].x)) / area;
        if (b < 0 || c < 0 || b + c > 1) continue;
        const float depth = p[0].z * (1 - b - c) + p[1].z * b + p[2].z * c;
        const std::size_t at = static_cast<std::size_t>(y) * kSamples + static_cast<std::size_t>(x);
        if (depth <= depth_[at]) continue;
        const vec4 texel = picture.at(uv[0] * (1 - b - c) + uv[1] * b + uv[2] * c);
        if (texel.w < 0.5f) continue;
        depth_[at] = depth;
        color_[at] = vec4(vec3(texel) / texel.w, 1);
      }
    }
  }

  void store(QImage& image, int left, int top) const {
    for (int y = 0; y < kInner; ++y) {
      uchar* row = image.scanLine(top + kGap + y) + 4 * (left + kGap);
      for (int x = 0; x < kInner; ++x, row += 4) {
        vec4 sum(0);
        for (int s = 0; s < kFine * kFine; ++s) {
          sum += color_[static_cast<std::size_t>(y * kFine + s / kFine) * kSamples +
                        static_cast<std::size_t>(x * kFine + s % kFine)];
        }
        if (!(sum.w > 0)) continue;
        for (int k = 0; k < 3; ++k) row[k] = byteOf(sum[k] / sum.w);
        row[3] = static_cast<uchar>(std::lround(255 * sum.w / (kFine * kFine)));
      }
    }
  }

 private:
  std::vector<float> depth_;
  std::vector<vec4> color_;
};

Canvas painted(const View& view, const CardPlace& place, const std::vector<LeafShape>& shapes,
               const std::vector<PlacedLeaf>& leaves, const std::vector<Small>& pictures) {
  Canvas canvas;
  const vec3 towards = glm::cross(view.right, view.up);
  const auto seen = [&](const vec3& p) {
    const vec3 offset = (p - place.center) / place.radius;
    return vec3((glm::dot(offset, view.right) + 1) * 0.5f * kSamples, (1 - glm::dot(offset, view.up)) * 0.5f * kSamples,
                glm::dot(offset, towards));
  };
  std::vector<vec3> corners;
  for (const std::uint32_t number : place.leaves) {
    const PlacedLeaf& leaf = leaves[number];
    const LeafShape& shape = shapes[static_cast<std::size_t>(leaf.shape)];
    corners.clear();
    for (const vec3& p : shape.positions) corners.push_back(seen(leaf.position + leaf.rotation * (leaf.size * p)));
    for (std::size_t i = 0; i + 2 < shape.indices.size(); i += 3) {
      const std::uint32_t a = shape.indices[i], b = shape.indices[i + 1], c = shape.indices[i + 2];
      canvas.triangle({corners[a], corners[b], corners[c]}, {shape.uvs[a], shape.uvs[b], shape.uvs[c]},
                      pictures[static_cast<std::size_t>(leaf.shape)]);
    }
  }
  return canvas;
}

/// Leaves are about so many samples long.
float lengthInSamples(const std::vector<PlacedLeaf>& leaves, const std::vector<CardPlace>& places) {
  double sum = 0, count = 0;
  for (const CardPlace& place : places) {
    for (const std::uint32_t leaf : place.leaves) {
      sum += static_cast<double>(leaves[leaf].size / (2 * place.radius) * kSamples);
      count += 1;
    }
  }
  return count > 0 ? static_cast<float>(sum / count) : 8;
}

}  // namespace

std::vector<CardPlace> cardPlaces(const sim::LeafClusters& clusters) {
  std::vector<CardPlace> places(clusters.nodes.size() - clusters.boughs);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const sim::LeafCluster& cluster = clusters.nodes[clusters.boughs + i];
    places[i].center = cluster.center;
    places[i].radius = cluster.radius;
  }
  for (std::uint32_t site = 0; site < clusters.ofSite.size(); ++site) {
    places[clusters.ofSite[site] - clusters.boughs].leaves.push_back(site);
  }
  return places;
}

LeafCards paintCards(const std::vector<LeafShape>& shapes, const std::vector<PlacedLeaf>& leaves,
                     const std::vector<CardPlace>& places) {
  LeafCards cards;
  if (places.empty() || shapes.empty()) return cards;
  const float length = lengthInSamples(leaves, places);
  std::vector<Small> pictures;
  for (const LeafShape& shape : shapes) pictures.push_back(shrunk(shape.image, length));
  const int count = static_cast<int>(places.size() * kViews.size());
  int across = 1;
  while (across * across < count) ++across;
  const int down = (count + across - 1) / across;
  cards.image = QImage(across * kTile, down * kTile, QImage::Format_RGBA8888);
  cards.image.fill(Qt::transparent);
  vec3 middle(0);
  for (const CardPlace& place : places) middle += place.center / static_cast<float>(places.size());
  int number = 0;
  for (const CardPlace& place : places) {
    for (const View& view : kViews) {
      const int left = number % across * kTile, top = number / across * kTile;
      painted(view, place, shapes, leaves, pictures).store(cards.image, left, top);
      const auto first = static_cast<std::uint32_t>(cards.positions.size());
      for (int corner = 0; corner < 4; ++corner) {
        const float x = (corner & 1) != 0 ? 1.0f : -1.0f, y = (corner & 2) != 0 ? 1.0f : -1.0f;
        const vec3 p = place.center + place.radius * (x * view.right + y * view.up);
        cards.positions.push_back(p);
        const vec3 out = p - middle + vec3(0, 0.3f * place.radius, 0);
        cards.normals.push_back(glm::length(out) > 1e-6f ? glm::normalize(out) : vec3(0, 1, 0));
        const float u = static_cast<float>(left + kGap) + 0.5f * (x + 1) * kInner;
        const float v = static_cast<float>(top + kGap) + 0.5f * (1 - y) * kInner;
        cards.uvs.push_back(
            {u / static_cast<float>(cards.image.width()), v / static_cast<float>(cards.image.height())});
        cards.bones.push_back(place.bone);
      }
      for (const std::uint32_t k : {0u, 1u, 2u, 2u, 1u, 3u}) cards.indices.push_back(first + k);
      ++number;
    }
  }
  cards.image = spreadColours(cards.image, 128);
  return cards;
}

}  // namespace windfall::model
