// Small scenes for the renderer's tests: a grown tree with leaves, drawn leaf pictures, pictures written on failure.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <vector>

#include "kernels/random.h"
#include "widgets/render/renderer.h"

namespace windfall::test {

/// A pointed oval leaf with veins, on nothing; sRGB with straight alpha. What is outside is `beyond` in colour.
inline render::Picture drawnLeaf(int width, int height, vec3 color, vec3 beyond = vec3(1, 1, 1)) {
  render::Picture picture{width, height, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float u = (static_cast<float>(x) + 0.5f) / static_cast<float>(width) * 2 - 1;
      const float v = 1 - (static_cast<float>(y) + 0.5f) / static_cast<float>(height);
      const float blade = (v - 0.14f) / 0.86f;
      float half = 0.022f;  // the petiole
      if (blade > 0) {
        const float teeth = 1 + 0.05f * std::sin(blade * 70);
        half = std::max(
            half, 0.93f * std::pow(std::sin(3.14159f * std::pow(blade, 0.72f)), 0.8f) * (1 - 0.25f * blade) * teeth);
      }
      const float inside = (half - std::abs(u)) * static_cast<float>(width) * 0.5f + 0.5f;
      const float alpha = std::min(1.f, std::max(0.f, inside));
      const float rib = std::exp(-u * u * 2500);
      const float side = std::pow(std::abs(std::sin((blade * 6.5f - std::abs(u) * 1.9f) * 3.14159f)), 24.f);
      const float mottle = 0.1f * std::sin(u * 9 + blade * 5) + 0.08f * std::sin(blade * 23 - u * 11);
      const vec3 tissue =
          color * (0.9f + mottle - 0.18f * std::abs(u)) + vec3(0.12f, 0.1f, 0.02f) * std::max(rib, side * 0.6f);
      const vec3 shown = alpha > 0 ? tissue : beyond;
      for (int c = 0; c < 3; ++c) {
        picture.rgba.push_back(static_cast<std::uint8_t>(std::min(255.f, std::max(0.f, shown[c] * 255))));
      }
      picture.rgba.push_back(static_cast<std::uint8_t>(std::lround(alpha * 255)));
    }
  }
  return picture;
}

/// A tree of tapered tubes whose links are its segments, with leaves at its twigs.
struct GrownTree {
  struct Segment {
    int parent = -1;
    vec3 from, to;
    float r0 = 0, r1 = 0;
  };
  render::Mesh mesh;
  std::vector<Segment> segments;
  std::vector<LeafInstance> leaves;
  std::vector<int> leafLinks;

  explicit GrownTree(std::uint64_t seed = 1, std::size_t leafCount = 3000, int layers = 4) {
    RandomSequence random(seed);
    branch(random, -1, vec3(0), vec3(0.04f, 1, 0.02f), 4.6f, 0.16f, 9, 0);
    mesh.materials.push_back({vec4(0.16f, 0.115f, 0.08f, 1), -1, 0.9f, false});
    for (std::size_t i = 0; i < segments.size(); ++i) tube(static_cast<std::uint32_t>(i));
    mesh.parts.push_back({0, static_cast<std::uint32_t>(mesh.indices.size()), 0});
    std::vector<int> twigs;
    for (std::size_t i = 0; i < segments.size(); ++i) {
      if (segments[i].r0 < 0.016f) twigs.push_back(static_cast<int>(i));
    }
    for (std::size_t i = 0; i < leafCount && !twigs.empty(); ++i)
      hang(random, twigs, static_cast<std::uint32_t>(layers));
  }

  /// Matrices (rest to world) of the tree bent by `sway` radians at its top, and its leaves with them.
  void write(const render::FrameSlot& slot, float sway) const {
    for (std::size_t i = 0; i < segments.size(); ++i) slot.bones[i] = bend(segments[i].from.y, sway);
    for (std::size_t i = 0; i < leaves.size() && i < slot.leaves.size(); ++i) {
      LeafInstance leaf = leaves[i];
      leaf.position = vec3(bend(leaf.position.y, sway) * vec4(leaf.position, 1));
      slot.leaves[i] = leaf;
    }
  }

 private:
  static mat4 bend(float height, float sway) {
    const float share = height / 6;
    return glm::rotate(mat4(1), -sway * share * share, vec3(0, 0, 1));
  }

  void branch(RandomSequence& random, int parent, vec3 from, vec3 along, float length, float radius, int pieces,
              int level) {
    vec3 at = from;
    int link = parent;
    for (int i = 0; i < pieces; ++i) {
      const float share = static_cast<float>(i + 1) / static_cast<float>(pieces);
      const auto jitter = [&] { return static_cast<float>(random.uniform(-1, 1)); };
      along = glm::normalize(along + vec3(jitter(), 0.35f + 0.25f * jitter(), jitter()) * (level == 0 ? 0.09f : 0.2f));
      const vec3 to = at + along * (length / static_cast<float>(pieces));
      const float r0 = radius * (1 - 0.85f * (share - 1.f / static_cast<float>(pieces))),
                  r1 = radius * (1 - 0.85f * share);
      segments.push_back({link, at, to, i == 0 && level == 0 ? r0 * 1.5f : r0, r1});
      link = static_cast<int>(segments.size()) - 1;
      if (level < 3 && (level > 0 || share > 0.3f)) {
        const int children = level == 0 ? 4 : 2;
        for (int c = 0; c < children; ++c) {
          const double around = random.uniform(0, 6.2831853);
          vec3 side = glm::cross(along, vec3(std::cos(around), 0.3, std::sin(around)));
          side = glm::normalize(side);
          const vec3 out = glm::normalize(side + along * (level == 0 ? 0.55f : 0.8f));
          const float shrink = level == 0 ? 0.62f * (1.15f - 0.6f * share) : 0.5f;
          branch(random, link, to, out, length * shrink, r1 * 0.62f + 0.002f, level == 2 ? 3 : 4, level + 1);
        }
      }
      at = to;
    }
  }

  void tube(std::uint32_t index) {
    const Segment& s = segments[index];
    const vec3 along = glm::normalize(s.to - s.from);
    const vec3 side = glm::normalize(glm::cross(along, std::abs(along.y) > 0.9f ? vec3(1, 0, 0) : vec3(0, 1, 0)));
    const vec3 other = glm::cross(along, side);
    const std::uint32_t sides = s.r0 > 0.04f ? 12 : s.r0 > 0.012f ? 6 : 3;
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (std::uint32_t i = 0; i <= sides; ++i) {
      const float angle = 6.2831853f * static_cast<float>(i) / static_cast<float>(sides);
      const vec3 normal = side * std::cos(angle) + other * std::sin(angle);
      for (const bool top : {false, true}) {
        render::Vertex vertex;
        vertex.position = (top ? s.to : s.from) + normal * (top ? s.r1 : s.r0);
        vertex.normal = normal;
        vertex.uv = vec2(angle * s.r0, top ? 1 : 0);
        vertex.links[0] = index;
        vertex.weights[0] = 1;
        mesh.vertices.push_back(vertex);
      }
      if (i == sides) break;
      const std::uint32_t v = first + 2 * i;
      for (const std::uint32_t corner : {v, v + 2, v + 1, v + 1, v + 2, v + 3}) mesh.indices.push_back(corner);
    }
  }

  void hang(RandomSequence& random, const std::vector<int>& twigs, std::uint32_t layers) {
    const int link = twigs[random.below(static_cast<std::uint32_t>(twigs.size()))];
    const Segment& s = segments[static_cast<std::size_t>(link)];
    LeafInstance leaf{};
    leaf.position = s.from + (s.to - s.from) * static_cast<float>(random.uniform());
    leaf.size = 0.075f + 0.04f * static_cast<float>(random.uniform());
    const auto jitter = [&] { return static_cast<float>(random.uniform(-1, 1)); };
    // Tips hang out and down, faces look up.
    const vec3 outwards =
        glm::normalize(vec3(leaf.position.x, 0, leaf.position.z) + vec3(jitter(), 0, jitter()) * 0.8f + vec3(1e-3f));
    const vec3 tip = glm::normalize(outwards + vec3(0, -0.5f + 0.4f * jitter(), 0));
    vec3 face = vec3(0, 1, 0) + vec3(jitter(), jitter(), jitter()) * 0.5f;
    const vec3 across = glm::normalize(glm::cross(tip, face));
    face = glm::cross(across, tip);
    const quat turn = glm::quat_cast(mat3(across, tip, face));
    leaf.rotation = vec4(turn.x, turn.y, turn.z, turn.w);
    leaf.layer = random.below(layers);
    leaf.curl = 0.35f * static_cast<float>(random.uniform());
    leaf.tint = jitter();
    leaves.push_back(leaf);
    leafLinks.push_back(link);
  }
};

/// The tree alone in a scene, with four autumn leaves as layers.
inline render::SceneContent contentOf(const GrownTree& tree) {
  render::SceneContent content;
  content.meshes.push_back(tree.mesh);
  content.trees.push_back({0, 0, static_cast<std::uint32_t>(tree.segments.size())});
  for (const vec3 color :
       {vec3(0.86f, 0.62f, 0.13f), vec3(0.80f, 0.44f, 0.10f), vec3(0.66f, 0.22f, 0.08f), vec3(0.60f, 0.60f, 0.16f)}) {
    content.leafLayers.push_back({drawnLeaf(160, 256, color), vec2(0.5f, 1.f), vec2(0.62f, 1.f)});
  }
  content.linkCount = tree.segments.size();
  content.leafCount = tree.leaves.size();
  return content;
}

/// Mean colour (0..255) of a rectangle of a picture.
inline vec3 meanColor(const render::Picture& picture, int x0, int y0, int x1, int y1) {
  vec3 sum(0);
  int count = 0;
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x, ++count) {
      const std::uint8_t* p = &picture.rgba[(static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                                             static_cast<std::size_t>(x)) *
                                            4];
      sum += vec3(p[0], p[1], p[2]);
    }
  }
  return count > 0 ? sum / static_cast<float>(count) : sum;
}

inline float brightness(const vec3& color) { return glm::dot(color, vec3(0.2126f, 0.7152f, 0.0722f)); }

/// As a PPM.
inline void writePicture(const render::Picture& picture, const std::string& path) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) return;
  std::fprintf(file, "P6 %d %d 255\n", picture.width, picture.height);
  for (std::size_t i = 0; i < picture.rgba.size(); i += 4) std::fwrite(&picture.rgba[i], 1, 3, file);
  std::fclose(file);
}

}  // namespace windfall::test
