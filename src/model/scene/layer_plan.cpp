#include "model/scene/layer_plan.h"

#include <algorithm>

namespace windfall::model {

LayerPlan planLayers(const Project& project) {
  LayerPlan plan;
  std::map<std::vector<AssetId>, LayerRange> byLeaves;
  for (const Plant& plant : project.plants) {
    const auto known = byLeaves.find(plant.leaves);
    if (known != byLeaves.end()) {
      plan.ofPlant[plant.id] = known->second;
      continue;
    }
    LayerRange range;
    range.first = static_cast<int>(plan.layers.size());
    for (const AssetId id : plant.leaves) {
      const Leaf* leaf = project.leaf(id);
      if (leaf == nullptr) continue;
      for (std::size_t i = 0; i < leaf->variants.size(); ++i) {
        if (leaf->variants[i].keep && !leaf->variants[i].image.isNull()) plan.layers.push_back({id, i});
      }
    }
    range.count = static_cast<int>(plan.layers.size()) - range.first;
    if (range.count == 0) {
      const auto standIn = std::find(plan.layers.begin(), plan.layers.end(), LayerSource{});
      range = {static_cast<int>(standIn - plan.layers.begin()), 1};
      if (standIn == plan.layers.end()) plan.layers.push_back({});
    }
    plan.ofPlant[plant.id] = byLeaves[plant.leaves] = range;
  }
  if (plan.layers.empty()) plan.layers.push_back({});
  return plan;
}

}  // namespace windfall::model
