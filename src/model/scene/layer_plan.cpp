#include "model/scene/layer_plan.h"

#include <algorithm>

#include "model/plant/grow/species_leaf.h"

namespace windfall::model {

LayerPlan planLayers(const Project& project) {
  LayerPlan plan;
  std::map<std::pair<std::vector<AssetId>, int>, LayerRange> byLeaves;
  for (const Plant& plant : project.plants) {
    const bool species = plant.grower && plant.file.isEmpty() && plant.grower->method != GrowMethod::Rule;
    const int look = species ? static_cast<int>(plant.grower->foliage.look) : -1;
    const auto known = byLeaves.find({plant.leaves, look});
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
      const LayerSource first{{}, 0, look};
      const auto standIn = std::find(plan.layers.begin(), plan.layers.end(), first);
      const int count = species ? growth::kLeafVariants : 1;
      range = {static_cast<int>(standIn - plan.layers.begin()), count};
      for (int k = 0; k < count && range.first + k >= static_cast<int>(plan.layers.size()); ++k) {
        plan.layers.push_back({{}, static_cast<std::size_t>(k), look});
      }
    }
    plan.ofPlant[plant.id] = byLeaves[{plant.leaves, look}] = range;
  }
  if (plan.layers.empty()) plan.layers.push_back({});
  return plan;
}

}  // namespace windfall::model
