// The list of a plant's branches with its search line.
#pragma once

#include <QSortFilterProxyModel>
#include <QWidget>
#include <vector>

#include "widgets/plant/branch_model.h"

class QLineEdit;
class QTreeView;

namespace windfall::widgets {

/// What is chosen here is what the attributes below and the view show.
class BranchPanel : public QWidget {
  Q_OBJECT
 public:
  explicit BranchPanel(QWidget* parent = nullptr);

  BranchModel& model() { return model_; }
  QTreeView* view() const { return view_; }
  QLineEdit* search() const { return search_; }
  /// The same plant again keeps what is chosen and open, by names.
  void setPlant(const model::LoadedPlant& plant);

  /// Links of all chosen rows, sorted, each once.
  std::vector<std::size_t> chosenLinks() const;
  /// Branches of which at least one link is chosen, in the order of the list.
  std::vector<int> chosenBranches() const;
  /// A click on a link in the view: Shift adds its branch, Ctrl toggles it, otherwise it replaces what is chosen.
  void clickLink(std::size_t link, Qt::KeyboardModifiers modifiers);
  /// Chooses these links (sorted), beside what is chosen or instead; branches that are whole show as such.
  void chooseLinks(const std::vector<std::size_t>& links, bool add);
  /// The same for one link alone, with the modifiers of a click.
  void clickSingle(std::size_t link, Qt::KeyboardModifiers modifiers);
  void clear();
  void chooseAll();

 signals:
  void chosenChanged();

 private:
  void filter(const QString& text);
  void clickRow(const QModelIndex& row, Qt::KeyboardModifiers modifiers);

  BranchModel model_;
  QSortFilterProxyModel proxy_;
  QLineEdit* search_;
  QTreeView* view_;
};

}  // namespace windfall::widgets
