// The branches of a plant as rows of a tree view: a branch opens into the branches that leave it and into its links.
#pragma once

#include <QAbstractItemModel>
#include <memory>
#include <set>
#include <vector>

#include "model/scene/assemble.h"

namespace windfall::widgets {

/// Read-only; made anew when the plant is loaded anew. Rows cost nothing until they are shown.
class BranchModel : public QAbstractItemModel {
  Q_OBJECT
 public:
  enum Column { Name, Length, Order, ColumnCount };
  using QAbstractItemModel::QAbstractItemModel;

  void setPlant(const model::LoadedPlant& plant);
  /// Bones that differ from the defaults: their rows, and their branches', are marked.
  void setEdited(const std::set<QString>& bones);

  /// Links of the plant's rigid bodies below a row: a link's own, or all of a branch (not of those that leave it).
  std::vector<std::size_t> links(const QModelIndex& index) const;
  QModelIndex branchIndex(int branch) const;
  /// The row of the branch that holds a link.
  QModelIndex branchOfLink(std::size_t link) const;
  /// The row of a link itself.
  QModelIndex indexOfLink(std::size_t link) const;
  /// -1 for a link's row.
  int branchAt(const QModelIndex& index) const;

  QModelIndex index(int row, int column, const QModelIndex& parent = {}) const override;
  QModelIndex parent(const QModelIndex& index) const override;
  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

 private:
  /// Branches come first in `nodes_`, by number; then links.
  struct Node {
    int parent = -1;  ///< node; -1: top level
    int row = 0;
    int bone = -1;  ///< of a link's row
    std::vector<int> children;
  };
  const Node* nodeAt(const QModelIndex& index) const;
  bool isBranch(int node) const { return node < branchCount_; }
  bool isEdited(int node) const;
  QString text(int node, int column) const;

  model::LoadedPlant plant_;
  std::vector<Node> nodes_;
  std::vector<int> top_;
  std::vector<int> nodeOfBone_;  ///< -1: in no branch
  std::vector<bool> edited_;     ///< by bone
  int branchCount_ = 0;
};

}  // namespace windfall::widgets
