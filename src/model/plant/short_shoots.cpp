#include "model/plant/short_shoots.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "model/plant/frames.h"

namespace windfall::model {

namespace {

/// A step near n times the golden ratio that shares no factor with n: its multiples fill a plant evenly.
std::size_t goldenStep(std::size_t n) {
  auto step = static_cast<std::size_t>(0.6180339887 * static_cast<double>(n)) + 1;
  while (std::gcd(step, n) != 1) ++step;
  return step;
}

void addCone(const ShortShoot& shoot, PlantGeometry& geometry) {
  const auto first = static_cast<std::uint32_t>(geometry.vertices.size());
  const quat frame = alongZ(shoot.direction);
  Vertex vertex{};
  vertex.bones[0] = shoot.bone;
  vertex.weights[0] = 1;
  for (int k = 0; k < 3; ++k) {
    const float angle = 2.0943951f * static_cast<float>(k);
    vertex.normal = frame * vec3(std::cos(angle), std::sin(angle), 0);
    vertex.position = shoot.base + vertex.normal * shoot.radius;
    vertex.uv = {static_cast<float>(k) / 3, 0};
    geometry.vertices.push_back(vertex);
  }
  vertex.normal = shoot.direction;
  vertex.position = shoot.base + shoot.direction * shoot.length;
  vertex.uv = {0.5f, -1};
  geometry.vertices.push_back(vertex);
  geometry.indices.insert(geometry.indices.end(), {first, first + 1, first + 3, first + 1, first + 2, first + 3,
                                                   first + 2, first, first + 3, first, first + 2, first + 1});
}

}  // namespace

void addShortShoots(const std::vector<ShortShoot>& shoots, int material, PlantGeometry& geometry) {
  const std::size_t count = shoots.size();
  if (count == 0) return;
  MeshPart part;
  part.firstIndex = static_cast<std::uint32_t>(geometry.indices.size());
  part.material = material;
  part.pieces = static_cast<std::uint32_t>(count);
  const std::size_t step = goldenStep(count);
  for (std::size_t i = 0, at = 0; i < count; ++i, at = (at + step) % count) {
    part.width = std::max(part.width, 2 * shoots[at].radius);
    addCone(shoots[at], geometry);
  }
  part.indexCount = static_cast<std::uint32_t>(geometry.indices.size()) - part.firstIndex;
  geometry.parts.push_back(part);
}

}  // namespace windfall::model
