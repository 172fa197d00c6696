// A plant made ready to be written: mesh, bones, leaves, motions.
#pragma once

#include "model/document/project.h"
#include "model/export/bone_reduction.h"
#include "model/leaf/atlas.h"
#include "model/progress.h"

namespace windfall::model {

enum class LeafExport {
  Instances,  ///< EXT_mesh_gpu_instancing on each bone
  Merged,     ///< one skinned mesh
  Nodes,      ///< a node a leaf
  None,
};

/// How finely an exported leaf follows its contour (leaf_mesh.h); all but the flat ones are folded and bent.
enum class LeafExportMesh {
  Automatic,  ///< medium; the hull where very many are merged
  Fine,
  Medium,
  Hull,       ///< flat, eight corners at most
  Rectangle,  ///< flat
};

struct PlantExportOptions {
  double detail = -1;  ///< 0..1; negative: the plant's own
  BoneLimits bones;
  LeafExport leaves = LeafExport::Merged;
  LeafExportMesh leafMesh = LeafExportMesh::Automatic;
  int levels = 1;  ///< static levels of detail, the first with `detail`
};

/// A leaf's blade for one picture: lengths in leaf lengths from the petiole's end, +y to the tip, +z out of the upper
/// face.
struct LeafShape {
  QString name;
  QImage image;
  QImage normalMap;  ///< as Material's
  std::vector<vec3> positions, normals;
  std::vector<vec2> uvs;
  std::vector<std::uint32_t> indices;
};

/// Where a leaf is: rest pose, plant space.
struct PlacedLeaf {
  int bone = 0, shape = 0;
  vec3 position{0};
  quat rotation{1, 0, 0, 0};
  float size = 0;  ///< m
};

/// Crossed cards of clusters of leaves, rest pose, plant space (leaf_cards.h).
struct LeafCards {
  QImage image;
  std::vector<vec3> positions, normals;
  std::vector<vec2> uvs;
  std::vector<int> bones;  ///< of each vertex
  std::vector<std::uint32_t> indices;
};

struct PlantModel {
  QString name;
  PlantGeometry geometry;              ///< what is hidden is gone; texture coordinates need no shader
  std::vector<PlantGeometry> coarser;  ///< further levels: vertices, indices, parts
  std::vector<LeafShape> shapes;
  std::vector<PlacedLeaf> leaves;
  LeafCards cards;  ///< what the leaves are from afar, where levels are asked for
  std::vector<Clip> clips;
};

/// Loads a plant of the project for export. Errors name the plant.
Result<PlantModel> modelOf(const Project& project, AssetId plant, const PlantExportOptions& options,
                           Progress& progress);

}  // namespace windfall::model
