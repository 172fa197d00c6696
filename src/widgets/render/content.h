// What a scene is made of, ready to be uploaded: meshes with skins, their pictures, leaf textures.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernels/math.h"

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
};

struct Part {
  std::uint32_t firstIndex = 0, indexCount = 0;
  int material = 0;
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
};

/// A layer of the leaf texture array.
struct LeafLayer {
  Picture picture;
  vec2 pivot{0.5f, 1};   ///< petiole's end in shares of the picture
  vec2 extent{0.6f, 1};  ///< width and height of the picture, in blade lengths
};

struct SceneContent {
  std::vector<Mesh> meshes;
  std::vector<TreeDraw> trees;
  std::vector<LeafLayer> leafLayers;
  std::size_t linkCount = 0, leafCount = 0;
};

}  // namespace windfall::render
