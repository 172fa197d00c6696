#include "model/plant/skeleton_organs.h"

#include <algorithm>
#include <cmath>

#include "model/plant/frames.h"

namespace windfall::model {

namespace {

std::size_t at(std::int32_t index) { return static_cast<std::size_t>(index); }

/// A blade that lacks water hangs: turned towards the ground by up to 70 degrees.
vec3 wilted(vec3 tip, float water) {
  const float length = glm::length(tip);
  if (!(length > 0) || water < 0 || water >= 0.95f) return tip;
  const vec3 direction = tip / length;
  const float drop = 1.22f * (1 - water / 0.95f);
  const vec3 axis = glm::cross(direction, vec3(0, -1, 0));
  const float sine = glm::length(axis);
  if (sine < 1e-4f) return tip;
  const float angle = std::min(drop, std::atan2(sine, -direction.y));
  return glm::angleAxis(angle, axis / sine) * tip;
}

void addLeafSites(const PlantSkeleton& skeleton, PlantGeometry& geometry) {
  for (const LeafOrgan& leaf : skeleton.graph.leaves) {
    if (leaf.segment < 0) continue;
    const Bone& bone = geometry.bones[at(leaf.segment)];
    const quat back = glm::conjugate(alongZ(bone.tail - bone.head));
    vec3 tip = leaf.tip - leaf.base;
    if (skeleton.settings.followsState) tip = wilted(tip, leaf.state.water);
    sim::LeafSite site;
    site.link = leaf.segment;
    site.position = back * (leaf.base - bone.head);
    site.rotation = glm::normalize(back * leafRotation(tip, leaf.normal.y < 0 ? -leaf.normal : leaf.normal));
    site.size = std::max(glm::length(tip), 0.002f);
    geometry.leafSites.push_back(site);
  }
}

/// A drop along the stem: rings of a half circle, pointed at the end.
void addBud(const BudOrgan& bud, const SkeletonGraph& graph, PlantGeometry& geometry) {
  constexpr int kRings = 5;
  constexpr std::uint32_t kSides = 6;
  const auto first = static_cast<std::uint32_t>(geometry.vertices.size());
  const Segment& stem = graph.segments[at(std::max(bud.segment, 0))];
  const quat frame = alongZ(stem.b - stem.a);
  for (int k = 0; k < kRings; ++k) {
    const float share = static_cast<float>(k) / (kRings - 1);
    const float width = std::sin(3.1415927f * std::sqrt(share)) + (k == 0 ? 0.3f : 0);
    for (std::uint32_t i = 0; i < kSides; ++i) {
      const float angle = 6.2831853f * static_cast<float>(i) / kSides;
      const vec3 out(std::cos(angle), std::sin(angle), 0);
      Vertex vertex{};
      vertex.position = bud.centre + frame * (bud.radius * (width * out + vec3(0, 0, 2.6f * share - 0.6f)));
      vertex.normal = frame * glm::normalize(out + vec3(0, 0, share - 0.4f));
      vertex.uv = {static_cast<float>(i) / kSides, share};
      vertex.bones[0] = static_cast<std::uint32_t>(std::max(bud.segment, 0));
      vertex.weights[0] = 1;
      geometry.vertices.push_back(vertex);
    }
  }
  for (std::uint32_t k = 0; k + 1 < kRings; ++k) {
    for (std::uint32_t i = 0; i < kSides; ++i) {
      const std::uint32_t a = first + k * kSides + i, b = first + k * kSides + (i + 1) % kSides;
      geometry.indices.insert(geometry.indices.end(), {a, b, a + kSides, b, b + kSides, a + kSides});
    }
  }
}

void addObstacle(const Obstacle& obstacle, PlantGeometry& geometry) {
  for (std::size_t i = 0; i + 2 < obstacle.triangles.size(); i += 3) {
    vec3 p[3];
    for (std::size_t k = 0; k < 3; ++k) p[k] = obstacle.points[obstacle.triangles[i + k]];
    const vec3 cross = glm::cross(p[1] - p[0], p[2] - p[0]);
    const float length = glm::length(cross);
    const vec3 normal = length > 0 ? cross / length : vec3(0, 1, 0);
    // Both sides: walls and umbrellas are open.
    for (const float side : {1.0f, -1.0f}) {
      for (std::size_t k = 0; k < 3; ++k) {
        Vertex vertex{};
        vertex.position = p[side > 0 ? k : 2 - k];
        vertex.normal = normal * side;
        vertex.weights[0] = 1;
        geometry.indices.push_back(static_cast<std::uint32_t>(geometry.vertices.size()));
        geometry.vertices.push_back(vertex);
      }
    }
  }
}

/// A part of what was added since `firstIndex`, in a plain colour.
void closePart(std::uint32_t firstIndex, const QString& name, vec4 colour, PlantGeometry& geometry) {
  const std::uint32_t count = static_cast<std::uint32_t>(geometry.indices.size()) - firstIndex;
  if (count == 0) return;
  Material material;
  material.name = name;
  material.baseColor = colour;
  // A plain picture: without one the renderer draws bark of its own.
  material.texture = QImage(4, 4, QImage::Format_RGBA8888);
  material.texture.fill(Qt::white);
  geometry.parts.push_back({firstIndex, count, static_cast<int>(geometry.materials.size()), false});
  geometry.materials.push_back(material);
}

}  // namespace

void addOrgans(const PlantSkeleton& skeleton, PlantGeometry& geometry) {
  addLeafSites(skeleton, geometry);
  auto first = static_cast<std::uint32_t>(geometry.indices.size());
  for (const BudOrgan& bud : skeleton.graph.buds) addBud(bud, skeleton.graph, geometry);
  closePart(first, QStringLiteral("bud"), vec4(0.20f, 0.22f, 0.06f, 1), geometry);
  first = static_cast<std::uint32_t>(geometry.indices.size());
  for (const Obstacle& obstacle : skeleton.graph.obstacles) addObstacle(obstacle, geometry);
  closePart(first, QStringLiteral("obstacle"), vec4(0.35f, 0.35f, 0.34f, 1), geometry);
}

}  // namespace windfall::model
