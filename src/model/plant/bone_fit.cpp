#include "model/plant/bone_fit.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "model/plant/mesh_pieces.h"

namespace windfall::model {

namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

/// Vertices of the bark by the bones that move them, each bone's in one run.
struct Grip {
  std::vector<std::uint32_t> piece;  ///< connected piece of the mesh, a value a vertex
  std::vector<std::uint32_t> first;
  std::vector<std::uint32_t> vertices;
};

Grip barkGrip(const PlantGeometry& geometry, float leastWeight) {
  Grip grip;
  grip.piece.assign(geometry.vertices.size(), 0);
  std::uint32_t pieces = 0;
  std::vector<char> bark(geometry.vertices.size(), 0);
  bool any = false;
  for (const MeshPart& part : geometry.parts) {
    const bool leaf = at(part.material) < geometry.materials.size() && geometry.materials[at(part.material)].leaf;
    if (leaf) continue;
    any = true;
    const MeshPieces connected = connectedPieces(geometry, part);
    for (std::uint32_t i = 0; i < part.indexCount; ++i) {
      const std::uint32_t vertex = geometry.indices[part.firstIndex + i];
      bark[vertex] = 1;
      grip.piece[vertex] = pieces + connected.ofTriangle[i / 3];
    }
    pieces += connected.count;
  }
  if (!any) std::fill(bark.begin(), bark.end(), 1);
  grip.first.assign(geometry.bones.size() + 1, 0);
  const auto each = [&](const auto& visit) {
    for (std::uint32_t v = 0; v < geometry.vertices.size(); ++v) {
      if (!bark[v]) continue;
      for (std::size_t k = 0; k < 4; ++k) {
        if (geometry.vertices[v].weights[k] >= leastWeight) visit(geometry.vertices[v].bones[k], v);
      }
    }
  };
  each([&](std::uint32_t bone, std::uint32_t) { ++grip.first[bone + 1]; });
  for (std::size_t i = 1; i < grip.first.size(); ++i) grip.first[i] += grip.first[i - 1];
  grip.vertices.resize(grip.first.back());
  std::vector<std::uint32_t> next(grip.first.begin(), grip.first.end() - 1);
  each([&](std::uint32_t bone, std::uint32_t v) { grip.vertices[next[bone]++] = v; });
  return grip;
}

/// The local axis (0..5: +x -x +y -y +z -z) along which most bones with one child run, or -1.
int commonAxis(const PlantGeometry& geometry, const BoneHints& hints, const std::vector<std::vector<int>>& children) {
  int votes[6] = {}, voters = 0;
  for (std::size_t b = 0; b < geometry.bones.size(); ++b) {
    if (children[b].size() != 1) continue;
    const vec3 along = geometry.bones[at(children[b][0])].head - geometry.bones[b].head;
    const float length = glm::length(along);
    if (length < 1e-5f) continue;
    const vec3 local = glm::transpose(hints.axes[b]) * (along / length);
    ++voters;
    for (int k = 0; k < 3; ++k) {
      if (std::abs(local[k]) > 0.99f) ++votes[2 * k + (local[k] < 0 ? 1 : 0)];
    }
  }
  const int best = static_cast<int>(std::max_element(votes, votes + 6) - votes);
  return votes[best] > 0 && votes[best] * 10 >= voters * 6 ? best : -1;
}

float median(std::vector<float>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Centre of the circle through the points by least squares (Kasa 1976): right on arcs too. False: no circle.
bool circleCentre(const std::vector<vec2>& points, vec2& centre) {
  glm::dvec2 mean(0);
  for (const vec2& p : points) mean += glm::dvec2(p);
  mean /= static_cast<double>(points.size());
  double xx = 0, xy = 0, yy = 0, xr = 0, yr = 0;
  for (const vec2& p : points) {
    const glm::dvec2 d = glm::dvec2(p) - mean;
    const double r = glm::dot(d, d);
    xx += d.x * d.x, xy += d.x * d.y, yy += d.y * d.y, xr += d.x * r, yr += d.y * r;
  }
  const double determinant = xx * yy - xy * xy, spread = xx + yy;
  if (!(determinant > 1e-3 * spread * spread)) return false;
  centre = vec2(mean + 0.5 * glm::dvec2(xr * yy - yr * xy, yr * xx - xr * xy) / determinant);
  return true;
}

/// Mean radius of the cross-sections of the vertices around a bone; 0 when they say nothing.
float sectionRadius(const PlantGeometry& geometry, const Bone& bone, const Grip& grip, std::size_t index) {
  constexpr int kStations = 4;
  const vec3 along = bone.tail - bone.head;
  const float length = glm::length(along);
  if (length < 1e-6f) return 0;
  const vec3 z = along / length;
  const vec3 x = glm::normalize(glm::cross(z, std::abs(z.y) < 0.9f ? vec3(0, 1, 0) : vec3(1, 0, 0)));
  const vec3 y = glm::cross(z, x);
  const auto share = [&](std::uint32_t v) { return glm::dot(geometry.vertices[v].position - bone.head, z) / length; };

  // Side branches often start inside the bark as pieces of their own; the bone's own piece is the one along all of it.
  std::map<std::uint32_t, std::pair<float, float>> spans;
  for (std::uint32_t i = grip.first[index]; i < grip.first[index + 1]; ++i) {
    const std::uint32_t v = grip.vertices[i];
    const float t = std::clamp(share(v), 0.0f, 1.0f);
    auto& span = spans.try_emplace(grip.piece[v], t, t).first->second;
    span = {std::min(span.first, t), std::max(span.second, t)};
  }
  const auto widest = std::max_element(spans.begin(), spans.end(), [](const auto& a, const auto& b) {
    return a.second.second - a.second.first < b.second.second - b.second.first;
  });

  std::vector<vec2> stations[kStations];
  std::vector<vec2> all;
  for (std::uint32_t i = grip.first[index]; i < grip.first[index + 1]; ++i) {
    const std::uint32_t v = grip.vertices[i];
    const float t = share(v);
    if (grip.piece[v] != widest->first || t < -0.1f || t > 1.1f) continue;
    const vec3 d = geometry.vertices[v].position - bone.head;
    const vec2 flat(glm::dot(d, x), glm::dot(d, y));
    all.push_back(flat);
    stations[std::clamp(static_cast<int>(t * kStations), 0, kStations - 1)].push_back(flat);
  }
  const auto radiusOf = [](const std::vector<vec2>& points) {
    vec2 centre(0);
    if (!circleCentre(points, centre)) return 0.0f;
    std::vector<float> distances;
    for (const vec2& p : points) distances.push_back(glm::length(p - centre));
    return median(distances);
  };
  float sum = 0;
  int used = 0;
  for (const auto& station : stations) {
    if (station.size() < 5) continue;
    const float radius = radiusOf(station);
    if (radius > 0) sum += radius, ++used;
  }
  if (used > 0) return sum / static_cast<float>(used);
  return all.size() >= 3 ? radiusOf(all) : 0;
}

}  // namespace

void fitTails(PlantGeometry& geometry, const BoneHints& hints) {
  std::vector<Bone>& bones = geometry.bones;
  std::vector<std::vector<int>> children(bones.size());
  for (std::size_t b = 0; b < bones.size(); ++b) {
    if (bones[b].parent >= 0) children[at(bones[b].parent)].push_back(static_cast<int>(b));
  }
  const int axis = commonAxis(geometry, hints, children);
  const Grip grip = barkGrip(geometry, 0.5f);

  for (std::size_t b = 0; b < bones.size(); ++b) {
    Bone& bone = bones[b];
    if (hints.ends[b]) {
      bone.tail = *hints.ends[b];
      continue;
    }
    vec3 direction(0);
    if (axis >= 0) direction = hints.axes[b][axis / 2] * (axis % 2 == 0 ? 1.0f : -1.0f);
    // The child that goes on farthest; with a known axis, of those that lie on it.
    int next = -1;
    float reach = 0;
    for (const int child : children[b]) {
      const vec3 d = bones[at(child)].head - bone.head;
      const float length = glm::length(d);
      const bool onAxis = axis < 0 || children[b].size() == 1 || glm::dot(d, direction) > 0.999f * length;
      if (onAxis && length > reach) reach = length, next = child;
    }
    if (axis < 0 && next >= 0) direction = (bones[at(next)].head - bone.head) / reach;
    const std::uint32_t* begin = grip.vertices.data() + grip.first[b];
    const std::uint32_t* end = grip.vertices.data() + grip.first[b + 1];
    if (direction == vec3(0) && begin != end) {
      vec3 mean(0);
      for (const std::uint32_t* v = begin; v != end; ++v) mean += geometry.vertices[*v].position - bone.head;
      const float length = glm::length(mean);
      if (length > 1e-9f) direction = mean / length;
    }
    float meshReach = 0;
    for (const std::uint32_t* v = begin; v != end; ++v) {
      meshReach = std::max(meshReach, glm::dot(geometry.vertices[*v].position - bone.head, direction));
    }
    // A child in the middle of the bone is a side branch: the mesh goes on beyond it.
    if (next >= 0 && meshReach < 1.5f * reach) {
      bone.tail = bones[at(next)].head;
    } else {
      bone.tail = bone.head + direction * std::max(meshReach, reach);
    }
  }
}

void fitRadii(PlantGeometry& geometry) {
  const Grip grip = barkGrip(geometry, 0.35f);
  for (std::size_t b = 0; b < geometry.bones.size(); ++b) {
    Bone& bone = geometry.bones[b];
    bone.radius = sectionRadius(geometry, bone, grip, b);
  }
}

}  // namespace windfall::model
