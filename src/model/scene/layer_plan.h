// Which leaf textures the scene shows, and in which layers of the texture array.
#pragma once

#include <map>
#include <vector>

#include "model/document/project.h"
#include "model/leaf/atlas.h"
#include "model/progress.h"
#include "sim/result.h"

namespace windfall::model {

/// The layers that the leaves of one plant choose from.
struct LayerRange {
  int first = 0, count = 1;
};

/// A layer: a kept variant of a leaf, or a painted stand-in.
struct LayerSource {
  AssetId leaf;             ///< 0: the stand-in
  std::size_t variant = 0;  ///< index in the leaf's variants, or of the species' stand-ins
  int look = -1;            ///< LeafLook of a stand-in; -1: a plain leaf
  bool operator==(const LayerSource&) const = default;
};

struct LayerPlan {
  std::vector<LayerSource> layers;  ///< never empty
  std::map<AssetId, LayerRange> ofPlant;
};

/// Follows from the project alone, without looking at pictures. Plants with the same leaves share their layers; a plant
/// without a kept variant gets the stand-ins of its species, or the plain one.
LayerPlan planLayers(const Project& project);

/// The textures of the plan. Each leaf's root and tip are found again from its photo (Stage::Contour).
Result<std::vector<LeafTexture>> makeLayers(const Project& project, const LayerPlan& plan, Progress& progress);

}  // namespace windfall::model
