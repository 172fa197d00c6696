// Undo steps that add and remove leaves, plants and placed trees.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "model/document/change.h"
#include "model/document/command.h"
#include "model/document/project.h"

namespace windfall::model {

/// The list that holds a kind of asset.
template <class T>
std::vector<T>& assetsOf(Project& project);

/// What watchers of a kind are told when one comes or goes.
template <class T>
Change presenceChange(AssetId id);

/// Adds an asset that already has its id at a place in its list.
template <class T>
class AddAsset : public DocumentCommand {
 public:
  AddAsset(Document& document, T asset, qsizetype place, quint64 nextId, const QString& text);
  void redo() override;
  void undo() override;

 private:
  T asset_;
  qsizetype place_;
  quint64 nextIdBefore_, nextIdAfter_;
};

/// Removes a leaf, and its name from the plants that wear it.
class RemoveLeaf : public DocumentCommand {
 public:
  RemoveLeaf(Document& document, AssetId id, const QString& text);
  void redo() override;
  void undo() override;

 private:
  AssetId id_;
  Leaf leaf_;
  qsizetype place_ = 0;
  std::vector<std::pair<AssetId, std::vector<AssetId>>> wearers_;  ///< plants and all their leaves before
  /// A leaf that takes colours from the removed one, and what it took from where before.
  struct Borrower {
    AssetId id;
    std::vector<AssetId> examples;
    std::vector<RegionPair> pairs;
  };
  std::vector<Borrower> borrowers_;
};

/// Removes placed trees; with `plant`, that plant too.
class RemoveTrees : public DocumentCommand {
 public:
  RemoveTrees(Document& document, std::optional<AssetId> plant, std::vector<AssetId> trees, const QString& text);
  void redo() override;
  void undo() override;

 private:
  void announceTrees();

  std::optional<AssetId> plantId_;
  Plant plant_;
  qsizetype plantPlace_ = 0;
  std::vector<std::pair<qsizetype, TreePlacement>> trees_;  ///< by place, ascending
};

}  // namespace windfall::model
