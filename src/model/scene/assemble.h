// From a project to what the simulation and the renderer need.
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "model/document/project.h"
#include "model/leaf/atlas.h"
#include "model/plant/bodies.h"
#include "model/plant/geometry_cache.h"
#include "model/progress.h"
#include "sim/engine.h"
#include "sim/result.h"

namespace windfall::model {

/// A plant, loaded: shared by all trees that show it.
struct LoadedPlant {
  std::shared_ptr<const PlantGeometry> geometry;
  std::shared_ptr<const PlantBodies> bodies;
};

struct SceneAssembly {
  std::map<AssetId, LoadedPlant> plants;
  std::vector<AssetId> trees;             ///< placements, in the order of sim.trees
  std::vector<LeafTexture> leafTextures;  ///< layers of the texture array; never empty (a plain drawn leaf stands in)
  sim::SceneDescription sim;  ///< link i of tree t is bone `bodies->boneOfLink` of its geometry, scaled and placed
};

/// The scene without its pictures: what the simulation needs; `leafTextures` stays empty. Scale is folded into each
/// tree. Errors name the plant. With `shapes` a plant whose shape is kept there is neither read nor grown again.
Result<SceneAssembly> assembleTrees(const Project& project, Progress& progress, GeometryCache* shapes = nullptr);

/// A tree `scale` times as large: lengths and radii, leaf areas by its square, leaves with it.
sim::Tree scaled(sim::Tree tree, double scale);

/// How many leaves kEveryLeaf stands for: one at each place of all trees, at most half a million; where they begin in
/// the air, some.
std::int32_t everyLeaf(const std::vector<sim::TreeInstance>& trees, const sim::LeafSettings& leaves);

/// Loads every plant of the scene, textures its leaves from the kept variants, and describes the simulation.
Result<SceneAssembly> assembleScene(const Project& project, Progress& progress, GeometryCache* shapes = nullptr);

}  // namespace windfall::model
