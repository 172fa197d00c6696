#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <optional>

#include "model/plant/assimp_private.h"

namespace windfall::model::assimp {

Transform transformOf(const aiMatrix4x4& m) {
  return Transform(m.a1, m.b1, m.c1, m.d1, m.a2, m.b2, m.c2, m.d2, m.a3, m.b3, m.c3, m.d3, m.a4, m.b4, m.c4, m.d4);
}

bool isFinite(const Transform& transform) {
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      if (!std::isfinite(transform[column][row])) return false;
    }
  }
  return true;
}

namespace {

constexpr std::size_t kMostNodes = 4'000'000;
constexpr double kAgreement = 1e-3;  // of bones on where their mesh stands

template <class T>
T metadata(const aiScene& scene, const char* key, T otherwise) {
  T value = otherwise;
  return scene.mMetaData != nullptr && scene.mMetaData->Get(key, value) ? value : otherwise;
}

/// Unit vector of an axis as FBX counts them.
glm::dvec3 axis(int index, int sign) {
  glm::dvec3 result(0);
  result[index] = sign < 0 ? -1 : 1;
  return result;
}

/// FBX says in which unit and along which axes it was written; glTF is metres and Y up by definition.
Transform toMetres(const aiScene& scene) {
  double centimetres = metadata<float>(scene, "UnitScaleFactor", 0);
  if (centimetres == 0) centimetres = metadata<double>(scene, "UnitScaleFactor", 1);
  if (!(centimetres > 0) || !std::isfinite(centimetres)) centimetres = 1;
  const int up = metadata<int>(scene, "UpAxis", 1), front = metadata<int>(scene, "FrontAxis", 2);
  const int right = metadata<int>(scene, "CoordAxis", 0);
  Transform turn(1);
  const bool axesAreThree = up >= 0 && front >= 0 && right >= 0 && up < 3 && front < 3 && right < 3 && up != front &&
                            front != right && right != up;
  // Newer versions of Assimp turn the root node themselves.
  if (axesAreThree && scene.mRootNode->mTransformation.IsIdentity()) {
    const glm::dvec3 x = axis(right, metadata<int>(scene, "CoordAxisSign", 1));
    const glm::dvec3 y = axis(up, metadata<int>(scene, "UpAxisSign", 1));
    const glm::dvec3 z = axis(front, metadata<int>(scene, "FrontAxisSign", 1));
    turn = glm::transpose(Transform(glm::dmat3(x, y, z)));
  }
  return glm::scale(Transform(1), glm::dvec3(centimetres * 0.01)) * turn;
}

/// Where the bones have a skinned mesh: the topmost one, and whether all say the same, as they do in their bind pose.
struct PlaceByBones {
  Transform place{1};
  bool agreed = true;
};

std::optional<PlaceByBones> placeByBones(const File& file, const aiMesh& mesh) {
  std::optional<PlaceByBones> result;
  int top = -1;
  std::vector<Transform> places;
  for (unsigned i = 0; i < mesh.mNumBones; ++i) {
    const auto found = file.nodeByName.find(mesh.mBones[i]->mName.C_Str());
    if (found == file.nodeByName.end()) continue;
    const Transform place =
        file.nodes[static_cast<std::size_t>(found->second)].global * transformOf(mesh.mBones[i]->mOffsetMatrix);
    if (!isFinite(place)) continue;
    places.push_back(place);
    if (top >= 0 && found->second >= top) continue;
    top = found->second;
    result = {place, true};
  }
  for (const Transform& place : places) {
    const double size = glm::length(glm::dvec3(result->place[0])), reach = glm::length(glm::dvec3(result->place[3]));
    for (int k = 0; k < 4; ++k) {
      const double off = glm::length(glm::dvec3(place[k]) - glm::dvec3(result->place[k]));
      if (!(off <= kAgreement * (k < 3 ? size : reach + 10 * size))) result->agreed = false;
    }
  }
  return result;
}

/// Whether two transforms scale alike.
bool sameSize(const Transform& a, const Transform& b) {
  const double x = std::abs(glm::determinant(glm::dmat3(a))), y = std::abs(glm::determinant(glm::dmat3(b)));
  return std::abs(x - y) <= 0.03 * y;
}

/// Where a skinned mesh stands when its bones are in their bind pose.
Transform bindTransform(const File& file, const aiMesh& mesh, int node) {
  const Node& own = file.nodes[static_cast<std::size_t>(node)];
  const auto byBones = placeByBones(file, mesh);
  if (!byBones) return file.toMetres * own.global;
  // In glTF a skinned mesh ignores its own node: the joints place it. In FBX too its node is no sure sign: Blender
  // writes unit and axes of a mesh below another twice.
  if (file.gltf || byBones->agreed) return file.toMetres * byBones->place;
  // The bones are posed: only their size can be trusted.
  if (sameSize(own.global, byBones->place)) return file.toMetres * own.global;
  const Transform local = transformOf(own.source->mTransformation);
  return file.toMetres * (sameSize(local, byBones->place) ? local : byBones->place);
}

}  // namespace

Result<File> indexScene(const aiScene& scene, bool gltf) {
  File file;
  file.scene = &scene;
  file.gltf = gltf;
  if (scene.mRootNode == nullptr) return Error{"holds no scene"};
  if (!gltf) file.toMetres = toMetres(scene);

  // Depth first without recursion: chains of bones are long, and files may be hostile.
  std::vector<std::pair<const aiNode*, int>> stack{{scene.mRootNode, -1}};
  while (!stack.empty()) {
    const auto [source, parent] = stack.back();
    stack.pop_back();
    if (file.nodes.size() >= kMostNodes) return Error{"has more than 4 million nodes"};
    const int index = static_cast<int>(file.nodes.size());
    Transform global = transformOf(source->mTransformation);
    if (parent >= 0) global = file.nodes[static_cast<std::size_t>(parent)].global * global;
    if (!isFinite(global)) {
      return Error{std::string("node \"") + source->mName.C_Str() + "\" has a transform that is not a number"};
    }
    file.nodes.push_back({source, parent, global, -1});
    file.nodeByName.emplace(source->mName.C_Str(), index);
    for (unsigned i = source->mNumChildren; i-- > 0;) stack.emplace_back(source->mChildren[i], index);
  }

  for (std::size_t i = 0; i < file.nodes.size(); ++i) {
    const aiNode& node = *file.nodes[i].source;
    for (unsigned k = 0; k < node.mNumMeshes; ++k) {
      if (node.mMeshes[k] >= scene.mNumMeshes) return Error{"a node names a mesh that is not there"};
      const aiMesh* mesh = scene.mMeshes[node.mMeshes[k]];
      if (!mesh->HasPositions() || !mesh->HasFaces()) continue;
      file.armature = file.armature || mesh->HasBones();
      file.instances.push_back({mesh, static_cast<int>(i), bindTransform(file, *mesh, static_cast<int>(i))});
    }
  }
  if (file.instances.empty()) return Error{"has no mesh"};
  return file;
}

}  // namespace windfall::model::assimp
