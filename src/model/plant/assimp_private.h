// The steps from an Assimp scene to a PlantGeometry; only the importer's own files include this.
#pragma once

#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <functional>
#include <glm/gtc/matrix_inverse.hpp>
#include <string>
#include <unordered_map>
#include <vector>

#include "model/plant/bone_fit.h"
#include "model/plant/geometry.h"
#include "model/progress.h"
#include "model/source_file.h"
#include "sim/result.h"

namespace windfall::model::assimp {

/// Double precision here: files in centimetres carry factors of 100 through long chains of bones.
using Transform = glm::dmat4;

/// A scene node, flattened; parents stand before children.
struct Node {
  const aiNode* source = nullptr;
  int parent = -1;
  Transform global{1};  ///< node to file space
  int bone = -1;        ///< index of the bone it became
};

/// A mesh where it stands.
struct Instance {
  const aiMesh* mesh = nullptr;
  int node = -1;
  Transform toPlant{1};  ///< bind pose of the mesh to plant space
};

/// The file, indexed.
struct File {
  const aiScene* scene = nullptr;
  bool gltf = false;
  Transform toMetres{1};  ///< file space to plant space: unit and up axis
  std::vector<Node> nodes;
  std::vector<Instance> instances;
  std::unordered_map<std::string, int> nodeByName;  ///< looked up, never iterated
  bool armature = false;                            ///< a mesh is bound to bones
};

/// Lower case, without the dot.
QString extensionOf(const SourceFile& file);

/// Reads a file as triangles and hands the scene to `use`; nothing else that the file names is read. All of it runs on
/// a stack as deep as the file's nodes, which Assimp walks by recursion. What Assimp or `use` throws becomes an error.
Status withScene(const SourceFile& file, Progress& progress, const std::function<Status(const aiScene&)>& use);

Transform transformOf(const aiMatrix4x4& matrix);
bool isFinite(const Transform& transform);

/// Flattens the nodes; an error for a scene without a mesh or with numbers that are none.
Result<File> indexScene(const aiScene& scene, bool gltf);

/// Fills the bones and their rest poses (bone to plant space); returns what the fit of tails needs.
Result<BoneHints> readBones(File& file, PlantGeometry& geometry, std::vector<Transform>& binds);

/// Fills the clips; what cannot be played is told in the notes.
void readClips(const File& file, const std::vector<Transform>& binds, PlantGeometry& geometry);

/// Fills vertices, indices, parts and maxInfluences.
Status readMeshes(const File& file, PlantGeometry& geometry);

/// Fills the materials, with the pictures that are inside the file.
void readMaterials(const aiScene& scene, PlantGeometry& geometry);

}  // namespace windfall::model::assimp
