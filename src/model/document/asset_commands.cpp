#include "model/document/asset_commands.h"

#include <algorithm>

namespace windfall::model {

template <>
std::vector<Leaf>& assetsOf<Leaf>(Project& project) {
  return project.leaves;
}
template <>
std::vector<Plant>& assetsOf<Plant>(Project& project) {
  return project.plants;
}
template <>
std::vector<TreePlacement>& assetsOf<TreePlacement>(Project& project) {
  return project.scene.trees;
}

template <>
Change presenceChange<Leaf>(AssetId id) {
  return {id, Aspect::Assets, {}};
}
template <>
Change presenceChange<Plant>(AssetId id) {
  return {id, Aspect::Assets, {}};
}
template <>
Change presenceChange<TreePlacement>(AssetId id) {
  return {id, Aspect::SceneTrees, {}};
}

namespace {

template <class T>
qsizetype placeOf(const std::vector<T>& items, AssetId id) {
  return std::find_if(items.begin(), items.end(), [id](const T& item) { return item.id == id; }) - items.begin();
}

}  // namespace

template <class T>
AddAsset<T>::AddAsset(Document& document, T asset, qsizetype place, quint64 nextId, const QString& text)
    : DocumentCommand(document, text),
      asset_(std::move(asset)),
      place_(place),
      nextIdBefore_(project().nextId),
      nextIdAfter_(nextId) {}

template <class T>
void AddAsset<T>::redo() {
  auto& items = assetsOf<T>(project());
  items.insert(items.begin() + place_, asset_);
  project().nextId = nextIdAfter_;
  announce(presenceChange<T>(asset_.id));
}

template <class T>
void AddAsset<T>::undo() {
  auto& items = assetsOf<T>(project());
  items.erase(items.begin() + place_);
  project().nextId = nextIdBefore_;
  announce(presenceChange<T>(asset_.id));
}

template class AddAsset<Leaf>;
template class AddAsset<Plant>;
template class AddAsset<TreePlacement>;

RemoveLeaf::RemoveLeaf(Document& document, AssetId id, const QString& text)
    : DocumentCommand(document, text), id_(id), place_(placeOf(project().leaves, id)) {
  leaf_ = project().leaves[place_];
  for (const Plant& plant : project().plants) {
    if (std::find(plant.leaves.begin(), plant.leaves.end(), id) != plant.leaves.end()) {
      wearers_.emplace_back(plant.id, plant.leaves);
    }
  }
  for (const Leaf& leaf : project().leaves) {
    const bool lends = std::find(leaf.examples.begin(), leaf.examples.end(), id) != leaf.examples.end() ||
                       std::any_of(leaf.regionPairs.begin(), leaf.regionPairs.end(),
                                   [id](const RegionPair& pair) { return pair.example == id; });
    if (lends && leaf.id != id) borrowers_.push_back({leaf.id, leaf.examples, leaf.regionPairs});
  }
}

void RemoveLeaf::redo() {
  project().leaves.erase(project().leaves.begin() + place_);
  for (const auto& [plant, leaves] : wearers_) std::erase(project().plant(plant)->leaves, id_);
  for (const Borrower& borrower : borrowers_) {
    Leaf& leaf = *project().leaf(borrower.id);
    std::erase(leaf.examples, id_);
    std::erase_if(leaf.regionPairs, [this](const RegionPair& pair) { return pair.example == id_; });
  }
  announce({id_, Aspect::Assets, {}});
  for (const Borrower& borrower : borrowers_) announce({borrower.id, Aspect::LeafExamples, {}});
  for (const auto& [plant, leaves] : wearers_) announce({plant, Aspect::PlantLeaves, {}});
}

void RemoveLeaf::undo() {
  project().leaves.insert(project().leaves.begin() + place_, leaf_);
  for (const auto& [plant, leaves] : wearers_) project().plant(plant)->leaves = leaves;
  for (const Borrower& borrower : borrowers_) {
    Leaf& leaf = *project().leaf(borrower.id);
    leaf.examples = borrower.examples;
    leaf.regionPairs = borrower.pairs;
  }
  announce({id_, Aspect::Assets, {}});
  for (const Borrower& borrower : borrowers_) announce({borrower.id, Aspect::LeafExamples, {}});
  for (const auto& [plant, leaves] : wearers_) announce({plant, Aspect::PlantLeaves, {}});
}

RemoveTrees::RemoveTrees(Document& document, std::optional<AssetId> plant, std::vector<AssetId> trees,
                         const QString& text)
    : DocumentCommand(document, text), plantId_(plant) {
  if (plantId_) {
    plantPlace_ = placeOf(project().plants, *plantId_);
    plant_ = project().plants[plantPlace_];
  }
  const auto& placed = project().scene.trees;
  for (qsizetype i = 0; i < qsizetype(placed.size()); ++i) {
    if (std::find(trees.begin(), trees.end(), placed[i].id) != trees.end()) trees_.emplace_back(i, placed[i]);
  }
}

void RemoveTrees::redo() {
  auto& placed = project().scene.trees;
  for (auto tree = trees_.rbegin(); tree != trees_.rend(); ++tree) placed.erase(placed.begin() + tree->first);
  if (plantId_) {
    project().plants.erase(project().plants.begin() + plantPlace_);
    announce({*plantId_, Aspect::Assets, {}});
  }
  announceTrees();
}

void RemoveTrees::undo() {
  if (plantId_) project().plants.insert(project().plants.begin() + plantPlace_, plant_);
  auto& placed = project().scene.trees;
  for (const auto& [place, tree] : trees_) placed.insert(placed.begin() + place, tree);
  if (plantId_) announce({*plantId_, Aspect::Assets, {}});
  announceTrees();
}

void RemoveTrees::announceTrees() {
  if (trees_.empty()) return;
  announce({trees_.size() == 1 ? trees_.front().second.id : AssetId{}, Aspect::SceneTrees, {}});
}

}  // namespace windfall::model
