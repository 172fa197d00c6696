#include "widgets/viewport/detail_bench_scene.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "model/plant/bark.h"
#include "model/plant/detail_mesh.h"
#include "widgets/viewport/detail_bench_tubes.h"
#include "widgets/viewport/scene_content.h"

namespace windfall::widgets {

namespace {

constexpr int kColumns = 10;
constexpr float kApart = 1.2f;   // m
constexpr float kBend = 0.025f;  ///< of a link against the one below, radians

/// The same bark on all three meshes.
void addBark(render::Mesh& mesh) {
  const model::Material bark = model::barkMaterial(model::BarkKind::Oak);
  mesh.pictures.push_back(toPicture(bark.texture));
  mesh.materials.push_back({bark.baseColor, 0, bark.roughness, false});
  mesh.parts.push_back({0, static_cast<std::uint32_t>(mesh.indices.size()), 0, true});
}

}  // namespace

BenchPlant makeBenchPlant(model::SkeletonGraph graph, float tolerance) {
  BenchPlant plant;
  const model::Chains chains = findChains(graph);
  const auto curves = makeCurves(graph, chains, model::CurveKind::Hermite);
  // The same surface for all three: seats, collars and tips as in the program. Without a foot, whose lobes belong to
  // the adaptive mesh's own shader.
  model::RingSettings settings;
  settings.flare = 0;
  const model::RingSet rings = makeRings(graph, chains, curves, settings);
  plant.adaptive = std::make_shared<DetailMesh>(makeDetail(graph, chains, curves, rings, {}));
  const TubeSource source{curves, rings, *plant.adaptive};
  plant.uniform = uniformTubes(source, 16, 8);
  plant.bounded = boundedTubes(source, tolerance);
  addBark(plant.uniform);
  addBark(plant.bounded);
  plant.graph = std::move(graph);
  return plant;
}

vec3 BenchScene::place(int tree) {
  const auto column = static_cast<float>(tree % kColumns), row = static_cast<float>(tree / kColumns);
  return {(column - 0.5f * (kColumns - 1)) * kApart, 0, -row * kApart};
}

render::SceneContent BenchScene::content(BenchMesh mesh) const {
  render::SceneContent content;
  for (const BenchPlant& plant : plants) {
    if (mesh == BenchMesh::Adaptive) {
      addBark(content.meshes.emplace_back());
      content.details.push_back(plant.adaptive);
    } else {
      content.meshes.push_back(mesh == BenchMesh::Uniform ? plant.uniform : plant.bounded);
    }
  }
  for (int i = 0; i < trees; ++i) {
    const auto plant = static_cast<std::size_t>(i) % plants.size();
    const auto links = static_cast<std::uint32_t>(plants[plant].graph.segments.size());
    content.trees.push_back({static_cast<int>(plant), static_cast<std::uint32_t>(content.linkCount), links,
                             mesh == BenchMesh::Adaptive ? static_cast<int>(plant) : -1});
    content.linkCount += links;
  }
  return content;
}

std::vector<mat4> BenchScene::pose(float time) const {
  std::vector<mat4> bones;
  for (int i = 0; i < trees; ++i) {
    const auto phase = static_cast<float>(i);
    const std::size_t first = bones.size();
    const mat4 root = glm::rotate(glm::translate(mat4(1), place(i)), 2.4f * phase, vec3(0, 1, 0));
    for (const model::Segment& segment : plants[static_cast<std::size_t>(i) % plants.size()].graph.segments) {
      // Each link turns about its foot, carried by what it grows from.
      const mat4 below = segment.parent < 0 ? root : bones[first + static_cast<std::size_t>(segment.parent)];
      const float bend = kBend * std::sin(1.7f * time + 0.9f * phase + 2 * segment.a.y);
      bones.push_back(glm::translate(glm::rotate(glm::translate(below, segment.a), bend, vec3(0, 0, 1)), -segment.a));
    }
  }
  return bones;
}

}  // namespace windfall::widgets
