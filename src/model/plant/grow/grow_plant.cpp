#include "model/plant/grow/grow_plant.h"

#include <algorithm>
#include <functional>
#include <future>

#include "model/plant/grow/axes.h"
#include "model/plant/grow/foliage_sites.h"
#include "model/plant/grow/species_bark.h"
#include "model/plant/grower_private.h"
#include "model/progress_part.h"

namespace windfall::model::growth {

namespace {

/// Triangles in two parts: bark, and the twigs that are too thin to have any.
void splitTwigs(float thinner, PlantGeometry& geometry) {
  std::vector<std::uint32_t> bark, twigs;
  const auto& from = geometry.indices;
  for (std::size_t i = 0; i + 2 < from.size(); i += 3) {
    const bool thin = geometry.bones[geometry.vertices[from[i]].bones[0]].radius < thinner;
    std::vector<std::uint32_t>& part = thin ? twigs : bark;
    part.insert(part.end(), {from[i], from[i + 1], from[i + 2]});
  }
  std::copy(twigs.begin(), twigs.end(), std::copy(bark.begin(), bark.end(), geometry.indices.begin()));
  std::uint32_t first = 0;
  int material = 0;
  for (const std::size_t count : {bark.size(), twigs.size()}) {
    const auto size = static_cast<std::uint32_t>(count);
    // What an adaptive mesh stands for is told by parts too.
    if (size > 0 || geometry.wood == WoodMesh::Left) geometry.parts.push_back({first, size, material, false});
    first += size, ++material;
  }
}

PlantGeometry dressed(const Grown& grown, const GrowerSettings& settings, WoodMesh wood,
                      const std::function<QImage()>& barkPicture) {
  const AxisTree tree = axesOf(grown);
  PlantGeometry geometry;
  geometry.format = QStringLiteral("grown");
  grower::addBones(tree.axes, geometry);
  geometry.nodes = static_cast<int>(geometry.bones.size());
  geometry.maxInfluences = 2;
  geometry.wood = wood;
  const TwigLook thin = twigLook(settings.wood.bark);
  grower::buildBark(tree.axes, geometry, {}, thin.thinner);
  splitTwigs(thin.thinner, geometry);
  placeFoliage(grown, tree, settings.foliage, settings.seed, 2, geometry);
  Material bark, twig;
  bark.name = QStringLiteral("bark");
  bark.baseColor = vec4(1);
  bark.texture = barkPicture();
  bark.roughness = 0.9f;
  twig.name = QStringLiteral("twig");
  twig.baseColor = thin.colour;
  twig.roughness = 0.8f;
  Material stalk = twig;
  twig.thinner = thin.thinner;
  stalk.name = QStringLiteral("stalk");
  geometry.materials = {bark, twig, stalk};
  return geometry;
}

}  // namespace

PlantGeometry dress(const Grown& grown, const GrowerSettings& settings) {
  return dressed(grown, settings, WoodMesh::Whole, [&] { return speciesBark(settings.wood.bark, settings.seed); });
}

Result<PlantGeometry> growPlant(const Plant& plant, Progress& progress, WoodMesh wood) {
  // Its picture needs nothing of the skeleton.
  auto bark = std::async(std::launch::async, [look = plant.grower->wood.bark, seed = plant.grower->seed] {
    return speciesBark(look, seed);
  });
  ProgressPart growing(progress, 0, 0.7);
  Result<GrownSkeleton> skeleton = growSkeleton(plant, growing);
  if (!skeleton) return skeleton.error();
  if (progress.cancelled()) return Error{"cancelled", true};
  PlantGeometry geometry = dressed(skeleton->grown, *plant.grower, wood, [&] { return bark.get(); });
  progress.report(1);
  return geometry;
}

}  // namespace windfall::model::growth
