// The list of leaves, plants and placed trees.
#pragma once

#include <QTreeWidget>

#include "model/document/document.h"

namespace windfall::widgets {

enum class AssetKind { Leaf, Plant, Tree };

/// Renames in place, duplicates, deletes; a leaf dropped on a plant, or a check box under the plant, hangs that leaf's
/// kept variants on it.
class AssetTree : public QTreeWidget {
  Q_OBJECT
 public:
  explicit AssetTree(model::Document& document, QWidget* parent = nullptr);

  /// The chosen asset, 0 for none or a group.
  model::AssetId current() const;
  void select(model::AssetId asset);
  QTreeWidgetItem* itemOf(model::AssetId asset) const;
  QTreeWidgetItem* groupOf(AssetKind kind) const { return groups_[int(kind)]; }
  /// The row below a plant that says whether a leaf hangs on it; null where there is none.
  QTreeWidgetItem* leafRow(model::AssetId plant, model::AssetId leaf) const;

  /// For the context menu and the window's menus; they act on what is chosen.
  QAction* renameAction() const { return rename_; }
  QAction* duplicateAction() const { return duplicate_; }
  QAction* deleteAction() const { return delete_; }

 signals:
  void chosen(windfall::model::AssetId asset, windfall::widgets::AssetKind kind);
  void opened(windfall::model::AssetId asset, windfall::widgets::AssetKind kind);
  void addRequested(windfall::widgets::AssetKind kind);

 protected:
  void dropEvent(QDropEvent* event) override;
  void dragMoveEvent(QDragMoveEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  void rebuild();
  void addAsset(AssetKind kind, model::AssetId id, const QString& name);
  void whenEdited(QTreeWidgetItem* item);
  void hang(model::AssetId leaf, model::AssetId plant, bool on);
  void updateActions();

  model::Document& document_;
  QTreeWidgetItem* groups_[3];
  QAction *rename_, *duplicate_, *delete_;
  bool rebuilding_ = false;
};

}  // namespace windfall::widgets
