#include <algorithm>
#include <cmath>
#include <set>

#include "model/plant/assimp_private.h"

namespace windfall::model::assimp {

namespace {

/// What the meshes say about a node.
struct Use {
  bool listed = false;     ///< some mesh names it as a bone
  double weight = 0;       ///< sum over all vertices
  double bindWeight = -1;  ///< weight in the mesh that `bind` comes from
  Transform bind{1};       ///< rest pose of the bone, plant space
  bool bone = false;
};

/// Exporters append such nodes only to say where the last bone of a chain ends.
bool isEndMarker(const std::string& name) {
  std::string lower = name;
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto endsWith = [&](const std::string& tail) {
    return lower.size() > tail.size() && lower.compare(lower.size() - tail.size(), tail.size(), tail) == 0;
  };
  return endsWith("_end") || endsWith(".end") || endsWith("nub");
}

/// Blender's glTF exporter hangs vertices that no bone holds on a bone that it makes up.
bool isMadeUp(const aiNode& node) {
  return node.mNumChildren == 0 && std::string(node.mName.C_Str()).rfind("neutral_bone", 0) == 0;
}

Status collectUses(const File& file, std::vector<Use>& uses) {
  for (const Instance& instance : file.instances) {
    for (unsigned i = 0; i < instance.mesh->mNumBones; ++i) {
      const aiBone& bone = *instance.mesh->mBones[i];
      const std::string name = bone.mName.C_Str();
      const auto found = file.nodeByName.find(name);
      if (found == file.nodeByName.end()) return Error{"bone \"" + name + "\" has no node in the armature"};
      Use& use = uses[static_cast<std::size_t>(found->second)];
      double weight = 0;
      for (unsigned k = 0; k < bone.mNumWeights; ++k) weight += bone.mWeights[k].mWeight;
      if (!std::isfinite(weight)) return Error{"bone \"" + name + "\" has a weight that is not a number"};
      use.listed = true;
      use.weight += weight;
      if (weight <= use.bindWeight) continue;
      use.bindWeight = weight;
      const Transform offset = transformOf(bone.mOffsetMatrix);
      if (!isFinite(offset) || std::abs(glm::determinant(offset)) < 1e-30) {
        return Error{"bone \"" + name + "\" has a bind pose that cannot be inverted"};
      }
      use.bind = instance.toPlant * glm::inverse(offset);
    }
  }
  return ok();
}

/// Listed nodes are bones, and what stands between them; end markers are not.
void chooseBones(const File& file, std::vector<Use>& uses) {
  const std::size_t count = file.nodes.size();
  std::vector<char> below(count, 0), above(count, 0);
  for (std::size_t i = count; i-- > 0;) {
    const Node& node = file.nodes[i];
    Use& use = uses[i];
    const bool marker = use.weight <= 0 && !below[i] && isEndMarker(node.source->mName.C_Str());
    use.bone = use.listed && !marker && !isMadeUp(*node.source);
    if ((use.bone || below[i]) && node.parent >= 0) below[static_cast<std::size_t>(node.parent)] = 1;
  }
  for (std::size_t i = 0; i < count; ++i) {
    const int parent = file.nodes[i].parent;
    above[i] = parent >= 0 && (uses[static_cast<std::size_t>(parent)].bone || above[static_cast<std::size_t>(parent)]);
    if (above[i] && below[i]) uses[i].bone = true;
  }
}

mat3 axesOf(const Transform& bind) {
  mat3 axes(1);
  for (int k = 0; k < 3; ++k) {
    const glm::dvec3 column(bind[k]);
    const double length = glm::length(column);
    if (length > 1e-12) axes[k] = vec3(column / length);
  }
  return axes;
}

}  // namespace

Result<BoneHints> readBones(File& file, PlantGeometry& geometry, std::vector<Transform>& binds) {
  std::vector<Use> uses(file.nodes.size());
  if (const Status status = collectUses(file, uses); !status) return status.error();
  chooseBones(file, uses);

  BoneHints hints;
  std::set<std::string> names;
  for (std::size_t i = 0; i < file.nodes.size(); ++i) {
    Node& node = file.nodes[i];
    Use& use = uses[i];
    const int parentNode = node.parent;
    // Unlisted nodes have no bind pose of their own: they keep their place against their parent.
    if (!use.listed) {
      use.bind = parentNode < 0
                     ? file.toMetres * node.global
                     : uses[static_cast<std::size_t>(parentNode)].bind *
                           glm::inverse(file.nodes[static_cast<std::size_t>(parentNode)].global) * node.global;
      if (!isFinite(use.bind)) use.bind = file.toMetres * node.global;
    }
    const int parentBone = parentNode < 0 ? -1 : file.nodes[static_cast<std::size_t>(parentNode)].bone;
    if (!use.bone) {
      const bool leaf = node.source->mNumChildren == 0 && node.source->mNumMeshes == 0;
      if (parentBone >= 0 && leaf && uses[static_cast<std::size_t>(parentNode)].bone) {
        hints.ends[static_cast<std::size_t>(parentBone)] = vec3(use.bind[3]);
      }
      node.bone = parentBone;
      continue;
    }
    std::string name = node.source->mName.C_Str();
    for (int copy = 1; !names.insert(name).second; ++copy) {
      name = std::string(node.source->mName.C_Str()) + "#" + std::to_string(copy);
    }
    Bone bone;
    bone.name = QString::fromStdString(name);
    bone.parent = parentBone;
    bone.head = bone.tail = vec3(use.bind[3]);
    bone.weighted = use.weight > 0;
    if (!(glm::length(bone.head) < 1e5f)) return Error{"bone \"" + name + "\" lies farther than 100 km away"};
    node.bone = static_cast<int>(geometry.bones.size());
    geometry.bones.push_back(std::move(bone));
    hints.ends.emplace_back();
    hints.axes.push_back(axesOf(use.bind));
    binds.push_back(use.bind);
  }
  const bool weighted =
      std::any_of(geometry.bones.begin(), geometry.bones.end(), [](const Bone& bone) { return bone.weighted; });
  if (!weighted) return Error{"has no armature: no bone moves any vertex of the mesh"};
  return hints;
}

}  // namespace windfall::model::assimp
