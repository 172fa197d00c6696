#include <algorithm>
#include <cmath>
#include <set>

#include "model/progress_part.h"
#include "model/scene/assemble.h"
#include "model/scene/layer_plan.h"

namespace windfall::model {

namespace {

constexpr double kRadians = 3.14159265358979 / 180;

Error about(const Plant& plant, const Error& error) {
  return {"plant \"" + plant.name.toStdString() + "\": " + error.message, error.cancelled};
}

}  // namespace

sim::Tree scaled(sim::Tree tree, double scale) {
  const auto s = static_cast<float>(scale);
  for (sim::Link& link : tree.links) {
    link.joint *= s;
    link.length *= s;
    link.radius *= s;
    link.leafArea *= s * s;
  }
  for (sim::LeafSite& site : tree.sites) {
    site.position *= s;
    site.size *= s;
  }
  return tree;
}

std::int32_t everyLeaf(const std::vector<sim::TreeInstance>& trees, const sim::LeafSettings& leaves) {
  std::size_t sites = 0;
  for (const sim::TreeInstance& tree : trees) sites += tree.tree->sites.size();
  if (leaves.spawnHeight > 0 || sites == 0) return sim::LeafSettings().count;
  return static_cast<std::int32_t>(std::min<std::size_t>(sites, 500'000));
}

Result<SceneAssembly> assembleTrees(const Project& project, Progress& progress, GeometryCache* shapes) {
  GeometryCache own;
  if (!shapes) shapes = &own;
  SceneAssembly assembly;
  const LayerPlan plan = planLayers(project);
  std::set<AssetId> placed;
  for (const TreePlacement& tree : project.scene.trees) placed.insert(tree.plant);

  const WoodMesh wood = project.scene.detail.adaptive ? WoodMesh::Left : WoodMesh::Whole;
  double done = 0;
  for (const Plant& plant : project.plants) {
    if (!placed.contains(plant.id)) continue;
    const auto all = static_cast<double>(placed.size());
    ProgressPart part(progress, done / all, (done + 1) / all);
    Result<std::shared_ptr<const PlantGeometry>> geometry = shapes->load(plant, part, wood);
    if (!geometry) return about(plant, geometry.error());
    if (progress.cancelled()) return Error{"cancelled", true};
    const LayerRange range = plan.ofPlant.at(plant.id);
    LoadedPlant loaded;
    loaded.geometry = *geometry;
    loaded.bodies = std::make_shared<PlantBodies>(buildBodies(**geometry, plant, range.first, range.count));
    assembly.plants.emplace(plant.id, std::move(loaded));
    done += 1;
  }

  for (const TreePlacement& tree : project.scene.trees) {
    const auto plant = assembly.plants.find(tree.plant);
    if (plant == assembly.plants.end()) {
      return Error{"tree \"" + tree.name.toStdString() + "\" shows a plant that is not in the project"};
    }
    if (!(tree.scale > 1e-4 && tree.scale < 1e4)) {
      return Error{"tree \"" + tree.name.toStdString() + "\" has a scale that makes no tree"};
    }
    sim::TreeInstance instance;
    const std::shared_ptr<const PlantBodies>& bodies = plant->second.bodies;
    instance.tree = tree.scale == 1 ? std::shared_ptr<const sim::Tree>(bodies, &bodies->tree)
                                    : std::make_shared<sim::Tree>(scaled(bodies->tree, tree.scale));
    instance.placement.position = {tree.position.x(), tree.position.y(), tree.position.z()};
    instance.placement.heading = static_cast<float>(tree.heading * kRadians);
    assembly.trees.push_back(tree.id);
    assembly.sim.trees.push_back(std::move(instance));
  }
  assembly.sim.wind = project.scene.wind;
  assembly.sim.leaves = project.scene.leaves;
  if (assembly.sim.leaves.count == kEveryLeaf) {
    assembly.sim.leaves.count = everyLeaf(assembly.sim.trees, assembly.sim.leaves);
  }
  assembly.sim.solver = project.scene.solver;
  assembly.sim.leafLayers = static_cast<std::uint32_t>(plan.layers.size());
  assembly.sim.seed = project.scene.seed;
  return assembly;
}

}  // namespace windfall::model
