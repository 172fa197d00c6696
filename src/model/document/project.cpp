#include "model/document/project.h"

namespace windfall::model {

namespace {

template <class Items>
auto* findById(Items& items, AssetId id) {
  for (auto& item : items) {
    if (item.id == id) return &item;
  }
  return static_cast<decltype(items.data())>(nullptr);
}

}  // namespace

Leaf* Project::leaf(AssetId id) { return findById(leaves, id); }
const Leaf* Project::leaf(AssetId id) const { return findById(leaves, id); }
Plant* Project::plant(AssetId id) { return findById(plants, id); }
const Plant* Project::plant(AssetId id) const { return findById(plants, id); }
TreePlacement* Project::tree(AssetId id) { return findById(scene.trees, id); }
const TreePlacement* Project::tree(AssetId id) const { return findById(scene.trees, id); }

}  // namespace windfall::model
