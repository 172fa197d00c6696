// Which trees of the scene are chosen; not part of the document and never undone.
#pragma once

#include <QObject>
#include <algorithm>
#include <vector>

#include "model/ids.h"

namespace windfall::widgets {

class SceneSelection : public QObject {
  Q_OBJECT
 public:
  using QObject::QObject;
  const std::vector<model::AssetId>& trees() const { return trees_; }
  bool contains(model::AssetId tree) const { return std::find(trees_.begin(), trees_.end(), tree) != trees_.end(); }
  void set(std::vector<model::AssetId> trees) {
    if (trees == trees_) return;
    trees_ = std::move(trees);
    emit changed();
  }
  /// Index of the chosen fan among the wind's, or -1.
  int fan() const { return fan_; }
  void setFan(int fan) {
    if (fan == fan_) return;
    fan_ = fan;
    emit fanChanged();
  }
  /// Shift adds, Ctrl toggles, a plain click replaces; 0 clears unless a modifier is held.
  void click(model::AssetId tree, Qt::KeyboardModifiers modifiers) {
    std::vector<model::AssetId> trees =
        modifiers & (Qt::ShiftModifier | Qt::ControlModifier) ? trees_ : decltype(trees_){};
    const auto found = std::find(trees.begin(), trees.end(), tree);
    if (tree && found == trees.end()) {
      trees.push_back(tree);
    } else if (found != trees.end() && modifiers & Qt::ControlModifier) {
      trees.erase(found);
    }
    set(std::move(trees));
  }

 signals:
  void changed();
  void fanChanged();

 private:
  int fan_ = -1;
  std::vector<model::AssetId> trees_;
};

}  // namespace windfall::widgets
