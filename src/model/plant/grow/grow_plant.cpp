#include "model/plant/grow/grow_plant.h"

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

/// Triangles in two parts: bark, and the twigs that are too thin to have any.
void splitTwigs(float thinner, PlantGeometry& geometry) {
  std::vector<std::uint32_t> bark, twigs;
  for (std::size_t i = 0; i + 2 < geometry.indices.size(); i += 3) {
    const Vertex& vertex = geometry.vertices[geometry.indices[i]];
    // Stalks of short shoots have three sides and no second bone.
    const bool thin = geometry.bones[vertex.bones[0]].radius < thinner;
    std::vector<std::uint32_t>& part = thin ? twigs : bark;
    part.insert(part.end(), geometry.indices.begin() + static_cast<std::ptrdiff_t>(i),
                geometry.indices.begin() + static_cast<std::ptrdiff_t>(i) + 3);
  }
  const auto first = static_cast<std::uint32_t>(bark.size()), rest = static_cast<std::uint32_t>(twigs.size());
  geometry.indices = std::move(bark);
  geometry.indices.insert(geometry.indices.end(), twigs.begin(), twigs.end());
  if (first > 0) geometry.parts.push_back({0, first, 0, false});
  if (rest > 0) geometry.parts.push_back({first, rest, 1, false});
}

}  // namespace

PlantGeometry dress(const Grown& grown, const GrowerSettings& settings) {
  const AxisTree tree = axesOf(grown);
  PlantGeometry geometry;
  geometry.format = QStringLiteral("grown");
  addBones(tree.axes, geometry);
  geometry.nodes = static_cast<int>(geometry.bones.size());
  geometry.maxInfluences = 2;
  grower::buildBark(tree.axes, geometry);
  placeFoliage(grown, tree, settings.foliage, settings.seed, geometry);
  const TwigLook thin = twigLook(settings.wood.bark);
  Material bark, twig;
  bark.name = QStringLiteral("bark");
  bark.baseColor = vec4(1);
  bark.texture = speciesBark(settings.wood.bark, settings.seed);
  bark.roughness = 0.9f;
  twig.name = QStringLiteral("twig");
  twig.baseColor = thin.colour;
  twig.roughness = 0.8f;
  geometry.materials = {bark, twig};
  splitTwigs(thin.thinner, geometry);
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
