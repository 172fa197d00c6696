// What an importer or a grower makes: skeleton, skinned mesh, materials. SI units, Y up.
#pragma once

#include <QImage>
#include <QString>
#include <QStringList>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "kernels/math.h"
#include "model/plant/clip.h"
#include "sim/tree.h"

namespace windfall::model {

/// A bone at rest; parents stand before children.
struct Bone {
  QString name;  ///< unique in its plant
  int parent = -1;
  vec3 head{0}, tail{0};  ///< m, plant space
  float radius = 0;       ///< m, mean of the mesh's cross-section along the bone
  bool weighted = true;
  /// The bone that continues its branch, -1: none; kByLength: the one with the longest way to a tip.
  int next = kByLength;
  static constexpr int kByLength = -2;
};

/// Skinned vertex; up to four influences (more are cut to the four largest and renormalised).
struct Vertex {
  vec3 position, normal;
  vec2 uv{0};
  std::array<std::uint32_t, 4> bones{};
  std::array<float, 4> weights{};
  /// Of generated bark: log2 of the texture's repeats round the stem (plant_meshing.md, 5); 0: `uv` as it is.
  float repeats = 0;
  /// Red, green, blue: on the colour, sRGB-free; the last: how much is wood, 0 green (255: as the material).
  std::array<std::uint8_t, 4> tint{255, 255, 255, 255};
};

struct Material {
  QString name;
  vec4 baseColor{0.5f, 0.5f, 0.5f, 1};  ///< linear
  QImage texture;                       ///< null: none
  QImage normalMap;                     ///< tangent space, y up the picture; null: none
  float roughness = 0.8f;
  bool leaf = false;  ///< foliage: name, alpha or small components say so
  float thinner = 0;  ///< m, of twigs: the radius below which stems have this material; 0: no twigs
  bool doubleSided = false;
};

/// A run of triangles with one material.
struct MeshPart {
  std::uint32_t firstIndex = 0, indexCount = 0;
  int material = 0;
  bool hidden = false;  ///< its leaves became instances
  /// Equal pieces that touch nothing, in an order whose every beginning is spread over the whole part, and a piece's
  /// width (m): from afar fewer and wider ones show the same. 0: one piece.
  std::uint32_t pieces = 0;
  float width = 0;
};

struct PlantSkeleton;

/// Whether stems that follow a skeleton have triangles. An adaptive mesh is made of the skeleton's rings, and needs
/// none.
enum class WoodMesh { Whole, Left };

struct PlantGeometry {
  QString format;  ///< "fbx", "glb", "gltf", "grown"
  std::vector<Bone> bones;
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;
  std::vector<MeshPart> parts;
  std::vector<Material> materials;
  int nodes = 0;          ///< scene nodes in the file
  int maxInfluences = 0;  ///< before any cut
  /// Leaves found in the mesh or placed by the grower; links are bone indices, frames those of bones (frames.h: +z from
  /// head to tail).
  std::vector<sim::LeafSite> leafSites;
  std::vector<Clip> clips;  ///< motions that the file holds
  QStringList notes;        ///< what was wrong with the file and how it was mended, a line each
  /// Left: parts made from the skeleton are there, without triangles.
  WoodMesh wood = WoodMesh::Whole;
  /// Curves and rings of its stems (skeleton_geometry.h); null where nobody made them.
  std::shared_ptr<const PlantSkeleton> skeleton;
};

}  // namespace windfall::model
