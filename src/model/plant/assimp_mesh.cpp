#include <algorithm>
#include <cmath>

#include "model/plant/assimp_private.h"
#include "model/plant/loose_vertices.h"

namespace windfall::model::assimp {

namespace {

struct Influence {
  std::uint32_t bone = 0;
  float weight = 0;
};

/// The influences of every vertex of a mesh, in one run.
struct Influences {
  std::vector<std::uint32_t> first;  ///< of each vertex; one more at the end
  std::vector<Influence> all;
};

/// Index of the plant's bone that a bone of a mesh became; -1: none.
int boneOf(const File& file, const aiBone& bone) {
  return file.nodes[static_cast<std::size_t>(file.nodeByName.at(bone.mName.C_Str()))].bone;
}

Result<Influences> collectInfluences(const File& file, const aiMesh& mesh) {
  Influences result;
  result.first.assign(mesh.mNumVertices + 1, 0);
  for (unsigned b = 0; b < mesh.mNumBones; ++b) {
    for (unsigned k = 0; k < mesh.mBones[b]->mNumWeights; ++k) {
      const aiVertexWeight& weight = mesh.mBones[b]->mWeights[k];
      if (weight.mVertexId >= mesh.mNumVertices) {
        return Error{std::string("bone \"") + mesh.mBones[b]->mName.C_Str() + "\" weighs a vertex that is not there"};
      }
      // Assimp pads bones without weights with one of 0.
      if (weight.mWeight > 0 && boneOf(file, *mesh.mBones[b]) >= 0) ++result.first[weight.mVertexId + 1];
    }
  }
  for (std::size_t i = 1; i < result.first.size(); ++i) result.first[i] += result.first[i - 1];
  result.all.resize(result.first.back());
  std::vector<std::uint32_t> next(result.first.begin(), result.first.end() - 1);
  for (unsigned b = 0; b < mesh.mNumBones; ++b) {
    const int bone = boneOf(file, *mesh.mBones[b]);
    if (bone < 0) continue;
    for (unsigned k = 0; k < mesh.mBones[b]->mNumWeights; ++k) {
      const aiVertexWeight& weight = mesh.mBones[b]->mWeights[k];
      if (weight.mWeight > 0) {
        result.all[next[weight.mVertexId]++] = {static_cast<std::uint32_t>(bone), weight.mWeight};
      }
    }
  }
  return result;
}

/// The four largest, renormalised; `fallback` moves a vertex that no bone holds, which is told by false.
bool setInfluences(Vertex& vertex, std::vector<Influence>& influences, std::uint32_t fallback) {
  std::sort(influences.begin(), influences.end(), [](const Influence& a, const Influence& b) {
    return a.weight != b.weight ? a.weight > b.weight : a.bone < b.bone;
  });
  const std::size_t count = std::min<std::size_t>(influences.size(), 4);
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) sum += influences[i].weight;
  if (!(sum > 0)) {
    vertex.bones[0] = fallback;
    vertex.weights[0] = 1;
    return false;
  }
  for (std::size_t i = 0; i < count; ++i) {
    vertex.bones[i] = influences[i].bone;
    vertex.weights[i] = static_cast<float>(influences[i].weight / sum);
  }
  return true;
}

/// Area-weighted normals for vertices that came without.
void makeNormals(PlantGeometry& geometry, std::size_t firstVertex, std::size_t firstIndex) {
  for (std::size_t i = firstIndex; i + 2 < geometry.indices.size(); i += 3) {
    Vertex* corner[3];
    for (std::size_t k = 0; k < 3; ++k) corner[k] = &geometry.vertices[geometry.indices[i + k]];
    const vec3 normal =
        glm::cross(corner[1]->position - corner[0]->position, corner[2]->position - corner[0]->position);
    for (Vertex* vertex : corner) vertex->normal += normal;
  }
  for (std::size_t i = firstVertex; i < geometry.vertices.size(); ++i) {
    vec3& normal = geometry.vertices[i].normal;
    const float length = glm::length(normal);
    normal = length > 1e-20f ? normal / length : vec3(0, 1, 0);
  }
}

Status readInstance(const File& file, const Instance& instance, PlantGeometry& geometry,
                    std::vector<std::uint32_t>& loose) {
  const aiMesh& mesh = *instance.mesh;
  const std::string name = mesh.mName.C_Str();
  Result<Influences> influences = collectInfluences(file, mesh);
  if (!influences) return influences.error();
  const glm::dmat3 normalMatrix = glm::inverseTranspose(glm::dmat3(instance.toPlant));
  const std::uint32_t fallback =
      static_cast<std::uint32_t>(std::max(0, file.nodes[static_cast<std::size_t>(instance.node)].bone));

  if (!mesh.HasBones() && file.armature && file.nodes[static_cast<std::size_t>(instance.node)].bone < 0) {
    const QString part = QString::fromUtf8(mesh.mName.C_Str()).left(60);
    geometry.notes << QStringLiteral("its mesh \"%1\" is bound to no bone and stands still").arg(part);
  }

  const std::size_t firstVertex = geometry.vertices.size(), firstIndex = geometry.indices.size();
  std::vector<Influence> own;
  for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
    Vertex vertex{};
    const aiVector3D& at = mesh.mVertices[v];
    vertex.position = vec3(instance.toPlant * glm::dvec4(at.x, at.y, at.z, 1));
    if (!(glm::length(vertex.position) < 1e5f)) {
      return Error{"mesh \"" + name + "\": vertex " + std::to_string(v) + " is not a place within 100 km"};
    }
    if (mesh.HasNormals()) {
      const aiVector3D& n = mesh.mNormals[v];
      const glm::dvec3 turned = normalMatrix * glm::dvec3(n.x, n.y, n.z);
      const double length = glm::length(turned);
      vertex.normal = length > 1e-20 && std::isfinite(length) ? vec3(turned / length) : vec3(0, 1, 0);
    }
    if (mesh.HasTextureCoords(0)) {
      const aiVector3D& uv = mesh.mTextureCoords[0][v];
      // Assimp counts v upwards; pictures are stored from the top.
      if (std::isfinite(uv.x) && std::isfinite(uv.y)) vertex.uv = vec2(uv.x, 1 - uv.y);
    }
    own.assign(influences->all.begin() + influences->first[v], influences->all.begin() + influences->first[v + 1]);
    geometry.maxInfluences = std::max(geometry.maxInfluences, static_cast<int>(own.size()));
    if (!setInfluences(vertex, own, fallback) && mesh.HasBones()) {
      loose.push_back(static_cast<std::uint32_t>(geometry.vertices.size()));
    }
    geometry.vertices.push_back(vertex);
  }
  // A mirrored node turns the triangles inside out.
  const bool mirrored = glm::determinant(glm::dmat3(instance.toPlant)) < 0;
  for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
    const aiFace& face = mesh.mFaces[f];
    if (face.mNumIndices != 3) continue;
    for (unsigned k = 0; k < 3; ++k) {
      const unsigned index = face.mIndices[mirrored ? 2 - k : k];
      if (index >= mesh.mNumVertices) return Error{"mesh \"" + name + "\" has a triangle outside its vertices"};
      geometry.indices.push_back(static_cast<std::uint32_t>(firstVertex) + index);
    }
  }
  if (!mesh.HasNormals()) makeNormals(geometry, firstVertex, firstIndex);
  if (geometry.indices.size() > firstIndex) {
    MeshPart part;
    part.firstIndex = static_cast<std::uint32_t>(firstIndex);
    part.indexCount = static_cast<std::uint32_t>(geometry.indices.size() - firstIndex);
    part.material = static_cast<int>(std::min(mesh.mMaterialIndex, file.scene->mNumMaterials - 1));
    geometry.parts.push_back(part);
  }
  return ok();
}

}  // namespace

Status readMeshes(const File& file, PlantGeometry& geometry) {
  std::vector<std::uint32_t> loose;
  for (const Instance& instance : file.instances) {
    if (geometry.vertices.size() + instance.mesh->mNumVertices > 100'000'000)
      return Error{"has over 100 million vertices"};
    if (Status status = readInstance(file, instance, geometry, loose); !status) return status;
  }
  if (geometry.parts.empty()) return Error{"has no mesh with triangles"};
  if (!loose.empty()) {
    geometry.notes << QStringLiteral("%1 vertices were held by no bone and follow what is nearest").arg(loose.size());
    holdLooseVertices(geometry, loose);
  }
  return ok();
}

}  // namespace windfall::model::assimp
