#include <algorithm>
#include <cmath>

#include "model/plant/assimp_private.h"
#include "model/plant/grow/crown_volume.h"

namespace windfall::model::growth {

namespace {

/// The two coordinates seen along an axis.
glm::dvec2 seenAlong(int axis, dvec3 p) { return {p[(axis + 1) % 3], p[(axis + 2) % 3]}; }

double cross(glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; }

}  // namespace

ClosedMesh::ClosedMesh(std::vector<dvec3> vertices, std::vector<int> triangles)
    : vertices_(std::move(vertices)), triangles_(std::move(triangles)) {
  if (!vertices_.empty()) lower_ = upper_ = vertices_[0];
  for (const dvec3& v : vertices_) lower_ = glm::min(lower_, v), upper_ = glm::max(upper_, v);
  for (int axis = 0; axis < 3; ++axis) {
    cells_[axis].resize(kCells * kCells);
    const glm::dvec2 low = seenAlong(axis, lower_), size = seenAlong(axis, upper_) - low;
    const auto cell = [&](double value, double from, double run) {
      return run > 0 ? std::clamp(static_cast<int>((value - from) / run * kCells), 0, kCells - 1) : 0;
    };
    for (std::size_t t = 0; t + 2 < triangles_.size(); t += 3) {
      glm::dvec2 least(1e300), most(-1e300);
      for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec2 p = seenAlong(axis, vertices_[at(triangles_[t + k])]);
        least = glm::min(least, p), most = glm::max(most, p);
      }
      for (int y = cell(least.y, low.y, size.y); y <= cell(most.y, low.y, size.y); ++y) {
        for (int x = cell(least.x, low.x, size.x); x <= cell(most.x, low.x, size.x); ++x) {
          cells_[axis][at(y * kCells + x)].push_back(static_cast<int>(t));
        }
      }
    }
  }
}

bool ClosedMesh::oddAlong(int axis, dvec3 point) const {
  const glm::dvec2 p = seenAlong(axis, point), low = seenAlong(axis, lower_), size = seenAlong(axis, upper_) - low;
  if (!(size.x > 0 && size.y > 0)) return false;
  const glm::dvec2 share = (p - low) / size * static_cast<double>(kCells);
  const int x = std::clamp(static_cast<int>(share.x), 0, kCells - 1),
            y = std::clamp(static_cast<int>(share.y), 0, kCells - 1);
  bool odd = false;
  for (const int t : cells_[axis][at(y * kCells + x)]) {
    dvec3 corner[3];
    glm::dvec2 flat[3];
    for (int k = 0; k < 3; ++k) {
      corner[k] = vertices_[at(triangles_[at(t + k)])];
      flat[k] = seenAlong(axis, corner[k]);
    }
    // Half-open edges: a ray through a shared edge counts one of its triangles.
    int sides = 0;
    for (int k = 0; k < 3; ++k) {
      const glm::dvec2 a = flat[k], b = flat[(k + 1) % 3];
      if ((a.y > p.y) == (b.y > p.y)) continue;
      if (p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) ++sides;
    }
    if (sides % 2 == 0) continue;
    const double area = cross(flat[1] - flat[0], flat[2] - flat[0]);
    if (area == 0) continue;
    const double w1 = cross(p - flat[0], flat[2] - flat[0]) / area, w2 = cross(flat[1] - flat[0], p - flat[0]) / area;
    const double depth =
        corner[0][axis] + w1 * (corner[1][axis] - corner[0][axis]) + w2 * (corner[2][axis] - corner[0][axis]);
    if (depth > point[axis]) odd = !odd;
  }
  return odd;
}

bool ClosedMesh::contains(dvec3 point) const {
  return static_cast<int>(oddAlong(0, point)) + static_cast<int>(oddAlong(1, point)) +
             static_cast<int>(oddAlong(2, point)) >=
         2;
}

Result<ClosedMesh> readCrownMesh(const SourceFile& file, Progress& progress) {
  std::vector<dvec3> vertices;
  std::vector<int> triangles;
  const Status status = assimp::withScene(file, progress, [&](const aiScene& scene) -> Status {
    const Result<assimp::File> indexed = assimp::indexScene(scene, assimp::extensionOf(file) != QLatin1String("fbx"));
    if (!indexed) return indexed.error();
    for (const assimp::Instance& instance : indexed->instances) {
      const auto first = static_cast<int>(vertices.size());
      for (unsigned i = 0; i < instance.mesh->mNumVertices; ++i) {
        const aiVector3D& v = instance.mesh->mVertices[i];
        const dvec3 placed = instance.toPlant * glm::dvec4(v.x, v.y, v.z, 1);
        if (!(std::isfinite(placed.x) && std::isfinite(placed.y) && std::isfinite(placed.z))) {
          return Error{"has a vertex that is not a number"};
        }
        vertices.push_back(placed);
      }
      for (unsigned i = 0; i < instance.mesh->mNumFaces; ++i) {
        const aiFace& face = instance.mesh->mFaces[i];
        if (face.mNumIndices != 3) continue;
        for (unsigned k = 0; k < 3; ++k) triangles.push_back(first + static_cast<int>(face.mIndices[k]));
      }
    }
    if (triangles.empty()) return Error{"has no triangles"};
    return ok();
  });
  if (!status) {
    const Error& error = status.error();
    return Error{error.cancelled ? error.message : "the crown's mesh " + error.message, error.cancelled};
  }
  return ClosedMesh(std::move(vertices), std::move(triangles));
}

}  // namespace windfall::model::growth
