// What a scene is made of, ready to be uploaded: meshes with skins, their pictures, leaf textures.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "kernels/detail_data.h"
#include "kernels/math.h"

namespace windfall::sim {
struct Tree;
}

namespace windfall::render {

/// 8-bit RGBA, rows from the top, sRGB with straight alpha (the renderer filters in linear, premultiplied light).
struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;
};

struct Vertex {
  vec3 position, normal;
  vec2 uv{0};
  std::uint32_t links[4]{};  ///< indices into the tree's own links
  float weights[4]{};
  float repeats = 0;                         ///< of generated bark: log2 of its picture's repeats round the stem
  std::uint8_t tint[4]{255, 255, 255, 255};  ///< on the colour; the last: share of wood, 0 green
};

struct Material {
  vec4 baseColor{0.5f, 0.5f, 0.5f, 1};  ///< linear
  int picture = -1;                     ///< index into Mesh::pictures
  float roughness = 0.8f;
  bool foliage = false;  ///< alpha-tested, lit from both sides
  float tile = 0;        ///< of generated bark on an adaptive mesh: width of its picture on the stem, m
  /// Of an adaptive mesh: linear colour of stems too thin for bark, and the radius (m) below which they are.
  vec4 twigs{0};
};

struct Part {
  std::uint32_t firstIndex = 0, indexCount = 0;
  int material = 0;
  bool adaptive = false;  ///< a tree's adaptive mesh stands for it, if it has one
  /// Equal pieces, each with vertices and indices of its own, in an order whose every beginning is spread over the
  /// whole part, and a piece's width (m): from afar fewer and wider ones are drawn. 0: one piece.
  std::uint32_t pieces = 0;
  float width = 0;
};

/// A skinned mesh, shared by all trees of one plant.
struct Mesh {
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;
  std::vector<Part> parts;
  std::vector<Material> materials;
  std::vector<Picture> pictures;
};

/// A tree in the scene: a mesh and where its links' matrices begin in the bone buffer.
struct TreeDraw {
  int mesh = 0;
  std::uint32_t firstLink = 0, linkCount = 0;
  int detail = -1;  ///< adaptive mesh that stands for parts of `mesh`, -1: none
};

/// A corner of a flat leaf; lengths in leaf lengths from the petiole's end.
struct LeafCorner {
  vec2 place{0};  ///< x to the right, y towards the tip
  float rib = 0;  ///< x from the midrib
  vec2 uv{0};     ///< shares of the picture, top left (0, 0)
};

struct LeafShape {
  std::vector<LeafCorner> corners;
  std::vector<std::uint32_t> indices;
};

/// Levels of detail of a leaf's shape, the finest first; the last is for leaves of a few pixels.
inline constexpr std::size_t kLeafLevels = 4;
/// Samples of a season from summer to the end of autumn.
inline constexpr std::size_t kSeasonSamples = 17;

/// A layer of the leaf texture arrays.
struct LeafLayer {
  Picture picture;
  vec2 pivot{0.5f, 1};   ///< petiole's end in shares of the picture
  vec2 extent{0.6f, 1};  ///< width and height of the picture, in leaf lengths

  std::array<LeafShape, kLeafLevels> levels{};  ///< empty ones: a grid over the picture
  /// Numbers, not colours: normal x and y (tangent space, +Y up), roughness, light that comes through (255: as much as
  /// through bare blade). Empty: flat.
  Picture surface{};
  /// When a place loses its green (0 first), when it browns, how much it reddens, how open to light. Empty: all alike.
  Picture ageing{};
  std::array<vec3, 3> gains{vec3(1), vec3(1), vec3(1)};  ///< on linear colour: yellow, red, brown
  /// Shares of leaves that are green, yellow, red, brown at the season's samples.
  std::array<vec4, kSeasonSamples> seasons = filled(vec4(1, 0, 0, 0));
  float redness = 0;       ///< strength of red where it is made, 0..1
  float wetness = 0.5f;    ///< wet leaves curl less
  float stalk = 0;         ///< share of the length that is petiole and stays straight
  float halfWidth = 0.3f;  ///< of the blade, leaf lengths

  static std::array<vec4, kSeasonSamples> filled(const vec4& value) {
    std::array<vec4, kSeasonSamples> samples;
    samples.fill(value);
    return samples;
  }
};

struct SceneContent {
  std::vector<Mesh> meshes;
  std::vector<std::shared_ptr<const DetailMesh>> details;
  std::vector<TreeDraw> trees;
  std::vector<LeafLayer> leafLayers;
  std::size_t linkCount = 0, leafCount = 0;
  /// Of each tree: the links and sites that the leaves hang on, for cards of clusters; empty: every leaf is drawn.
  std::vector<std::shared_ptr<const sim::Tree>> leafTrees;
  std::uint64_t leafSeed = 1;  ///< as the simulation's
};

}  // namespace windfall::render
