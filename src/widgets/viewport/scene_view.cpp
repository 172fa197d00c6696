#include "widgets/viewport/scene_view.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>

namespace windfall::widgets {

namespace {
constexpr double kDegrees = std::numbers::pi / 180;
}  // namespace

vec3 sunDirection(const model::Light& light) {
  const double azimuth = light.azimuth * kDegrees, elevation = light.elevation * kDegrees;
  return {static_cast<float>(std::sin(azimuth) * std::cos(elevation)), static_cast<float>(std::sin(elevation)),
          static_cast<float>(-std::cos(azimuth) * std::cos(elevation))};
}

render::View sceneView(const model::Camera& camera, const model::Scene& scene) {
  render::View view;
  view.eye = eyeOf(camera);
  view.target = {camera.target.x(), camera.target.y(), camera.target.z()};
  view.fieldOfView = static_cast<float>(camera.fieldOfView * kDegrees);
  view.toSun = sunDirection(scene.light);
  view.season = scene.leaves.season;
  view.sunStrength = static_cast<float>(scene.light.strength);
  view.wind = scene.wind.direction * scene.wind.speed;
  view.adaptive = scene.detail.adaptive;
  view.tolerance = static_cast<float>(scene.detail.tolerance);
  view.cardsBelow = scene.detail.cards ? static_cast<float>(scene.detail.cardsBelow) : 0;
  return view;
}

std::optional<Box> sceneBox(const model::SceneAssembly& assembly, const model::Scene& scene) {
  std::optional<Box> all;
  for (const model::AssetId id : assembly.trees) {
    const auto placed =
        std::find_if(scene.trees.begin(), scene.trees.end(), [&](const auto& tree) { return tree.id == id; });
    if (placed == scene.trees.end()) continue;
    const auto heading = static_cast<float>(placed->heading * kDegrees), scale = static_cast<float>(placed->scale);
    const vec3 at(placed->position.x(), placed->position.y(), placed->position.z());
    const auto add = [&](vec3 place) {
      const vec3 p = place * scale;
      const vec3 world = at + vec3(p.x * std::cos(heading) + p.z * std::sin(heading), p.y,
                                   p.z * std::cos(heading) - p.x * std::sin(heading));
      if (!all) all = Box{world, world};
      all->lower = glm::min(all->lower, world);
      all->upper = glm::max(all->upper, world);
    };
    const model::PlantGeometry& geometry = *assembly.plants.at(placed->plant).geometry;
    for (const model::Vertex& vertex : geometry.vertices) add(vertex.position);
    if (geometry.wood == model::WoodMesh::Whole) continue;
    for (const model::Bone& bone : geometry.bones) {
      for (const vec3 end : {bone.head, bone.tail}) add(end - bone.radius), add(end + bone.radius);
    }
  }
  return all;
}

}  // namespace windfall::widgets
