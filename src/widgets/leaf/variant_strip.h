// The gallery below the canvas: new textures with seed, heart and scores.
#pragma once

#include <QWidget>

#include "model/document/document.h"

class QLabel;
class QListWidget;
class QPushButton;

namespace windfall::widgets {

class NumberBox;
class VariantScores;

/// A click on the heart keeps or drops a variant for atlas and trees, Delete removes the chosen ones, a double click
/// shows one large.
class VariantStrip : public QWidget {
  Q_OBJECT
 public:
  explicit VariantStrip(model::Document& document, QWidget* parent = nullptr);
  void setLeaf(model::AssetId leaf);
  QListWidget* list() const { return list_; }
  QPushButton* makeButton() const { return make_; }
  NumberBox* countBox() const { return count_; }
  /// -1: none.
  int current() const;
  void select(int index);
  void toggleKeep(int index);
  void removeSelected();
  void setBusy(bool busy);
  /// Shows these beside each variant and asks for those of the leaf shown; must live as long.
  void setScores(VariantScores* scores);

 signals:
  void makeRequested(int count);
  void chosen(int index);
  void opened(int index);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void refresh();
  void showScores();
  void updateButton();

  model::Document& document_;
  model::AssetId leaf_;
  QListWidget* list_;
  QPushButton* make_;
  NumberBox* count_;
  QLabel *hint_, *summary_;
  VariantScores* scores_ = nullptr;
  bool busy_ = false;
};

}  // namespace windfall::widgets
