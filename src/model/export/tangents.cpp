#include "model/export/tangents.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace windfall::model {

std::vector<vec4> tangentsOf(std::span<const vec3> positions, std::span<const vec3> normals, std::span<const vec2> uvs,
                             std::span<const std::uint32_t> indices) {
  // Lengyel 2001: sums over the triangles at a vertex, weighted by their area.
  std::vector<vec3> along(positions.size(), vec3(0)), down(positions.size(), vec3(0));
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
    const std::uint32_t a = indices[i], b = indices[i + 1], c = indices[i + 2];
    const vec3 e1 = positions[b] - positions[a], e2 = positions[c] - positions[a];
    const vec2 d1 = uvs[b] - uvs[a], d2 = uvs[c] - uvs[a];
    const float area = d1.x * d2.y - d2.x * d1.y;
    if (!(std::abs(area) > 1e-12f)) continue;
    const float sign = area < 0 ? -1.f : 1.f;
    const vec3 u = sign * (d2.y * e1 - d1.y * e2), v = sign * (d1.x * e2 - d2.x * e1);
    for (const std::uint32_t corner : {a, b, c}) along[corner] += u, down[corner] += v;
  }
  std::vector<vec4> tangents(positions.size());
  for (std::size_t i = 0; i < tangents.size(); ++i) {
    const vec3 n = normals[i];
    vec3 t = along[i] - n * glm::dot(n, along[i]);
    if (!(glm::dot(t, t) > 1e-30f)) t = glm::cross(n, std::abs(n.y) < 0.9f ? vec3(0, 1, 0) : vec3(1, 0, 0));
    t = glm::normalize(t);
    tangents[i] = vec4(t, glm::dot(glm::cross(n, t), down[i]) > 0 ? -1 : 1);
  }
  return tangents;
}

}  // namespace windfall::model
