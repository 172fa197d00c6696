#include "model/plant/foliage.h"

#include <QRegularExpression>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "model/plant/frames.h"
#include "model/plant/mesh_pieces.h"

namespace windfall::model {

namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

/// Larger pieces are no leaves but crowns in one mesh.
constexpr std::size_t kMostTriangles = 512;
constexpr float kLargestLeaf = 1.0f;  ///< m

/// A connected piece of a leaf part: its triangles (index of their first index).
struct Piece {
  std::vector<std::uint32_t> triangles;
};

std::vector<Piece> piecesOf(const PlantGeometry& geometry, const MeshPart& part) {
  const MeshPieces connected = connectedPieces(geometry, part);
  std::vector<Piece> pieces(connected.count);
  for (std::size_t i = 0; i < connected.ofTriangle.size(); ++i) {
    pieces[connected.ofTriangle[i]].triangles.push_back(part.firstIndex + 3 * static_cast<std::uint32_t>(i));
  }
  return pieces;
}

float extent(const PlantGeometry& geometry, const Piece& piece) {
  vec3 low(std::numeric_limits<float>::max()), high(-std::numeric_limits<float>::max());
  for (const std::uint32_t triangle : piece.triangles) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const vec3 p = geometry.vertices[geometry.indices[triangle + k]].position;
      low = glm::min(low, p), high = glm::max(high, p);
    }
  }
  return glm::length(high - low);
}

bool isLeafSized(const PlantGeometry& geometry, const Piece& piece) {
  return piece.triangles.size() <= kMostTriangles && extent(geometry, piece) <= kLargestLeaf;
}

/// The bone that moves the piece most.
int mainBone(const PlantGeometry& geometry, const Piece& piece) {
  std::map<std::uint32_t, double> weights;
  for (const std::uint32_t triangle : piece.triangles) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const Vertex& vertex = geometry.vertices[geometry.indices[triangle + k]];
      for (std::size_t i = 0; i < 4; ++i) {
        if (vertex.weights[i] > 0) weights[vertex.bones[i]] += static_cast<double>(vertex.weights[i]);
      }
    }
  }
  const auto best = std::max_element(weights.begin(), weights.end(),
                                     [](const auto& a, const auto& b) { return a.second < b.second; });
  return best == weights.end() ? 0 : static_cast<int>(best->first);
}

sim::LeafSite siteOf(const PlantGeometry& geometry, const Piece& piece) {
  const int link = mainBone(geometry, piece);
  const Bone& bone = geometry.bones[at(link)];
  vec3 base(0), normal(0), tip(0);
  float nearest = std::numeric_limits<float>::max(), farthest = -1;
  for (const std::uint32_t triangle : piece.triangles) {
    vec3 corner[3];
    for (std::uint32_t k = 0; k < 3; ++k) {
      corner[k] = geometry.vertices[geometry.indices[triangle + k]].position;
      const vec3 foot = bone.head + (bone.tail - bone.head) * closestShare(bone.head, bone.tail, corner[k]);
      const float distance = glm::length(corner[k] - foot);
      if (distance < nearest) nearest = distance, base = corner[k];
    }
    const vec3 face = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
    normal += face.y < 0 ? -face : face;
  }
  for (const std::uint32_t triangle : piece.triangles) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const vec3 p = geometry.vertices[geometry.indices[triangle + k]].position;
      const float distance = glm::length(p - base);
      if (distance > farthest) farthest = distance, tip = p;
    }
  }
  const quat frame = alongZ(bone.tail - bone.head);
  sim::LeafSite site;
  site.link = link;
  site.position = glm::conjugate(frame) * (base - bone.head);
  site.rotation = glm::conjugate(frame) * leafRotation(tip - base, normal);
  site.size = std::max(farthest, 0.002f);
  return site;
}

bool nameSaysLeaf(const QString& name) {
  static const QRegularExpression leafy(
      QStringLiteral("leaf|leaves|foliage|frond|needle|blatt|blätter|laub|feuille|hoja|list(?:y|í)"),
      QRegularExpression::CaseInsensitiveOption);
  static const QRegularExpression bare(QStringLiteral("leafless|bark|trunk|wood|stem"),
                                       QRegularExpression::CaseInsensitiveOption);
  return leafy.match(name).hasMatch() && !bare.match(name).hasMatch();
}

/// More than a tenth of the picture is a hole.
bool hasHoles(const QImage& picture) {
  if (picture.isNull() || !picture.hasAlphaChannel()) return false;
  const QImage small = picture.scaled(64, 64).convertToFormat(QImage::Format_ARGB32);
  int holes = 0;
  for (int y = 0; y < small.height(); ++y) {
    for (int x = 0; x < small.width(); ++x) holes += qAlpha(small.pixel(x, y)) < 64;
  }
  return holes * 10 > small.width() * small.height();
}

bool fallsApart(const PlantGeometry& geometry, const MeshPart& part) {
  if (part.indexCount < 3 * 40) return false;
  const std::vector<Piece> pieces = piecesOf(geometry, part);
  if (pieces.size() < 20) return false;
  return std::all_of(pieces.begin(), pieces.end(), [&](const Piece& piece) {
    return piece.triangles.size() <= 16 && extent(geometry, piece) <= 0.5f * kLargestLeaf;
  });
}

}  // namespace

void detectFoliage(PlantGeometry& geometry) {
  bool bark = false;
  for (Material& material : geometry.materials) {
    material.leaf = nameSaysLeaf(material.name) || hasHoles(material.texture);
    if (material.leaf) material.doubleSided = true;
  }
  for (const MeshPart& part : geometry.parts) bark = bark || !geometry.materials[at(part.material)].leaf;
  if (geometry.parts.size() < 2 || !bark) return;
  std::vector<char> small(geometry.parts.size());
  for (std::size_t i = 0; i < geometry.parts.size(); ++i) {
    // Stalks of short shoots in what Windfall wrote are small pieces too.
    const bool stalks = geometry.materials[at(geometry.parts[i].material)].name == QLatin1String("stalk");
    small[i] = !stalks && fallsApart(geometry, geometry.parts[i]);
  }
  if (std::all_of(small.begin(), small.end(), [](char s) { return s != 0; })) return;
  // Leaves that share their material with the wood, as where a file has none, get one of their own.
  std::map<int, int> own;
  for (std::size_t i = 0; i < geometry.parts.size(); ++i) {
    if (small[i]) continue;
    own.emplace(geometry.parts[i].material, -1);
  }
  for (std::size_t i = 0; i < geometry.parts.size(); ++i) {
    if (!small[i]) continue;
    int& material = geometry.parts[i].material;
    if (const auto shared = own.find(material); shared != own.end()) {
      if (shared->second < 0) {
        shared->second = static_cast<int>(geometry.materials.size());
        geometry.materials.push_back(geometry.materials[at(material)]);
        geometry.materials.back().name = (geometry.materials.back().name + QStringLiteral(" leaves")).trimmed();
      }
      material = shared->second;
    }
    geometry.materials[at(material)].leaf = geometry.materials[at(material)].doubleSided = true;
  }
}

void extractLeaves(PlantGeometry& geometry) {
  std::vector<MeshPart> parts;
  std::vector<std::uint32_t> indices;
  indices.reserve(geometry.indices.size());
  const auto append = [&](const MeshPart& like, const std::vector<Piece>& pieces, bool hidden) {
    MeshPart part = like;
    part.firstIndex = static_cast<std::uint32_t>(indices.size());
    part.hidden = hidden;
    for (const Piece& piece : pieces) {
      for (const std::uint32_t triangle : piece.triangles) {
        for (std::uint32_t k = 0; k < 3; ++k) indices.push_back(geometry.indices[triangle + k]);
      }
    }
    part.indexCount = static_cast<std::uint32_t>(indices.size()) - part.firstIndex;
    if (part.indexCount > 0) parts.push_back(part);
  };
  for (const MeshPart& part : geometry.parts) {
    if (!geometry.materials[at(part.material)].leaf) {
      Piece whole;
      for (std::uint32_t i = 0; i + 2 < part.indexCount; i += 3) whole.triangles.push_back(part.firstIndex + i);
      append(part, {whole}, false);
      continue;
    }
    std::vector<Piece> leaves, rest;
    for (Piece& piece : piecesOf(geometry, part)) {
      if (isLeafSized(geometry, piece)) {
        geometry.leafSites.push_back(siteOf(geometry, piece));
        leaves.push_back(std::move(piece));
      } else {
        rest.push_back(std::move(piece));
      }
    }
    append(part, leaves, true);
    append(part, rest, false);
  }
  geometry.parts = std::move(parts);
  geometry.indices = std::move(indices);
}

}  // namespace windfall::model
