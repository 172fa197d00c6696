#include "model/plant/grower.h"

#include <cmath>

#include "model/plant/grow/species_bark.h"
#include "model/plant/grower_private.h"
#include "model/plant/links_private.h"

namespace windfall::model {

namespace {

Status check(const GrowerSettings& s) {
  const auto within = [](double value, double low, double high) { return value >= low && value <= high; };
  if (!within(s.height, 0.5, 60)) return Error{"the grower's height must be 0.5 to 60 m"};
  if (!within(s.baseRadius, 0.002, s.height / 6)) {
    return Error{"the grower's base radius must be 2 mm to a sixth of the height"};
  }
  if (s.limbs < 0 || s.limbs > 400) return Error{"the grower makes 0 to 400 limbs"};
  if (s.levels < 1 || s.levels > 4) return Error{"the grower makes 1 to 4 levels"};
  if (!within(s.spread, 5, 120)) return Error{"the grower's spread must be 5 to 120 degrees"};
  return ok();
}

}  // namespace

Result<PlantGeometry> grow(const GrowerSettings& settings, Progress& progress, WoodMesh woodMesh) {
  if (const Status status = check(settings); !status) return status.error();
  std::vector<grower::Axis> axes = grower::growAxes(settings);
  grower::setRadii(axes, static_cast<float>(settings.baseRadius));
  progress.report(0.3);
  if (progress.cancelled()) return Error{"cancelled", true};

  PlantGeometry geometry;
  geometry.format = QStringLiteral("grown");
  grower::addBones(axes, geometry);
  geometry.nodes = static_cast<int>(geometry.bones.size());
  geometry.maxInfluences = 2;
  geometry.wood = woodMesh;
  grower::buildBark(axes, geometry);
  geometry.parts.push_back({0, static_cast<std::uint32_t>(geometry.indices.size()), 0, false});
  grower::placeLeaves(axes, naturalLeafArea(geometry.bones, findBranches(geometry.bones)), settings.seed, 1, geometry);
  Material bark;
  bark.name = QStringLiteral("bark");
  bark.baseColor = vec4(1);
  bark.texture = grower::barkTexture(settings.seed);
  bark.roughness = 0.9f;
  // Stalks of short shoots are no part of the skeleton.
  Material stalk;
  stalk.name = QStringLiteral("stalk");
  stalk.baseColor = growth::twigLook(BarkLook::Plain).colour;
  geometry.materials = {bark, stalk};
  progress.report(1);
  return geometry;
}

}  // namespace windfall::model
