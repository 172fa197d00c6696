#include "model/plant/grow/grow_plant.h"

#include <algorithm>
#include <cstdio>

#include "model/plant/grow/axes.h"
#include "model/plant/grow/foliage_sites.h"
#include "model/plant/grow/species_bark.h"
#include "model/plant/grower_private.h"
#include "model/progress_part.h"

namespace windfall::model::growth {

namespace {

void addBones(const std::vector<grower::Axis>& axes, PlantGeometry& geometry) {
  for (const grower::Axis& axis : axes) {
    for (std::size_t i = 0; i + 1 < axis.nodes.size(); ++i) {
      char digits[16];
      std::snprintf(digits, sizeof digits, axis.order == 0 ? ".%03d" : ".%02d", static_cast<int>(i));
      Bone bone;
      bone.name = QString::fromStdString(axis.name + digits);
      bone.parent = i > 0             ? static_cast<int>(geometry.bones.size()) - 1
                    : axis.parent < 0 ? -1
                                      : axes[at(axis.parent)].firstBone + axis.parentLink;
      bone.head = axis.nodes[i];
      bone.tail = axis.nodes[i + 1];
      bone.radius = 0.5f * (axis.radii[i] + axis.radii[i + 1]);
      geometry.bones.push_back(bone);
    }
  }
}

/// Triangles in three parts: bark, the twigs that are too thin to have any, and from `stalks` on the stalks of short
/// shoots, which are no part of the skeleton.
void splitTwigs(float thinner, std::size_t stalks, PlantGeometry& geometry) {
  std::vector<std::uint32_t> bark, twigs;
  const auto& from = geometry.indices;
  for (std::size_t i = 0; i + 2 < stalks; i += 3) {
    const bool thin = geometry.bones[geometry.vertices[from[i]].bones[0]].radius < thinner;
    std::vector<std::uint32_t>& part = thin ? twigs : bark;
    part.insert(part.end(), {from[i], from[i + 1], from[i + 2]});
  }
  std::copy(twigs.begin(), twigs.end(), std::copy(bark.begin(), bark.end(), geometry.indices.begin()));
  std::uint32_t first = 0;
  int material = 0;
  for (const std::size_t count : {bark.size(), twigs.size(), from.size() - stalks}) {
    const auto size = static_cast<std::uint32_t>(count);
    if (size > 0) geometry.parts.push_back({first, size, material, false});
    first += size, ++material;
  }
}

}  // namespace

PlantGeometry dress(const Grown& grown, const GrowerSettings& settings) {
  const AxisTree tree = axesOf(grown);
  PlantGeometry geometry;
  geometry.format = QStringLiteral("grown");
  addBones(tree.axes, geometry);
  geometry.nodes = static_cast<int>(geometry.bones.size());
  geometry.maxInfluences = 2;
  const TwigLook thin = twigLook(settings.wood.bark);
  grower::buildBark(tree.axes, geometry, {}, thin.thinner);
  const std::size_t stalks = geometry.indices.size();
  placeFoliage(grown, tree, settings.foliage, settings.seed, geometry);
  Material bark, twig;
  bark.name = QStringLiteral("bark");
  bark.baseColor = vec4(1);
  bark.texture = speciesBark(settings.wood.bark, settings.seed);
  bark.roughness = 0.9f;
  twig.name = QStringLiteral("twig");
  twig.baseColor = thin.colour;
  twig.roughness = 0.8f;
  Material stalk = twig;
  stalk.name = QStringLiteral("stalk");
  geometry.materials = {bark, twig, stalk};
  splitTwigs(thin.thinner, stalks, geometry);
  return geometry;
}

Result<PlantGeometry> growPlant(const Plant& plant, Progress& progress) {
  ProgressPart growing(progress, 0, 0.7);
  Result<GrownSkeleton> skeleton = growSkeleton(plant, growing);
  if (!skeleton) return skeleton.error();
  if (progress.cancelled()) return Error{"cancelled", true};
  PlantGeometry geometry = dress(skeleton->grown, *plant.grower);
  progress.report(1);
  return geometry;
}

}  // namespace windfall::model::growth
