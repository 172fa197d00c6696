#include "widgets/plant/branch_panel.h"

#include <QHeaderView>
#include <QLineEdit>
#include <QTreeView>
#include <QVBoxLayout>
#include <algorithm>
#include <set>

#include "widgets/look/icon.h"
#include "widgets/look/look.h"

namespace windfall::widgets {

BranchPanel::BranchPanel(QWidget* parent) : QWidget(parent), search_(new QLineEdit(this)), view_(new QTreeView(this)) {
  proxy_.setSourceModel(&model_);
  proxy_.setFilterKeyColumn(BranchModel::Name);
  proxy_.setFilterCaseSensitivity(Qt::CaseInsensitive);
  proxy_.setRecursiveFilteringEnabled(true);
  search_->setPlaceholderText(tr("Search branches"));
  search_->setClearButtonEnabled(true);
  search_->addAction(icon("search"), QLineEdit::LeadingPosition);
  search_->setObjectName("branch.search");
  view_->setObjectName("branch.list");
  view_->setModel(&proxy_);
  view_->setUniformRowHeights(true);
  view_->setSelectionMode(QAbstractItemView::ExtendedSelection);
  view_->setSelectionBehavior(QAbstractItemView::SelectRows);
  view_->setAllColumnsShowFocus(true);
  view_->setIndentation(4 * kGrid);
  view_->header()->setStretchLastSection(false);
  view_->header()->setMinimumSectionSize(48);
  view_->header()->setSectionResizeMode(BranchModel::Name, QHeaderView::Stretch);
  view_->header()->setSectionResizeMode(BranchModel::Length, QHeaderView::Fixed);
  view_->header()->setSectionResizeMode(BranchModel::Order, QHeaderView::Fixed);
  view_->header()->resizeSection(BranchModel::Length, 76);
  view_->header()->resizeSection(BranchModel::Order, 56);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(2 * kGrid, 2 * kGrid, 2 * kGrid, 0);
  column->setSpacing(kGrid);
  column->addWidget(search_);
  column->addWidget(view_, 1);
  connect(search_, &QLineEdit::textChanged, this, &BranchPanel::filter);
  connect(view_->selectionModel(), &QItemSelectionModel::selectionChanged, this, &BranchPanel::chosenChanged);
}

void BranchPanel::setPlant(const model::LoadedPlant& plant) {
  std::set<QString> chosen;
  for (const QModelIndex& index : view_->selectionModel()->selectedRows()) chosen.insert(index.data().toString());
  model_.setPlant(plant);
  QItemSelection selection;
  const int branches = plant.bodies ? static_cast<int>(plant.bodies->branches.size()) : 0;
  for (int branch = 0; branch < branches; ++branch) {
    const QModelIndex index = proxy_.mapFromSource(model_.branchIndex(branch));
    if (index.isValid() && chosen.contains(index.data().toString())) selection.select(index, index);
  }
  // The trunks open: their limbs are what is looked for first.
  for (int row = 0; row < proxy_.rowCount(); ++row) view_->expand(proxy_.index(row, 0));
  view_->selectionModel()->select(selection, QItemSelectionModel::ClearAndSelect | QItemSelectionModel::Rows);
  emit chosenChanged();
}

void BranchPanel::filter(const QString& text) {
  proxy_.setFilterFixedString(text);
  if (!text.isEmpty()) {
    view_->expandAll();
  } else if (const auto chosen = view_->selectionModel()->selectedRows(); !chosen.isEmpty()) {
    view_->scrollTo(chosen.front());
  }
}

std::vector<std::size_t> BranchPanel::chosenLinks() const {
  std::set<std::size_t> links;
  for (const QModelIndex& index : view_->selectionModel()->selectedRows()) {
    for (const std::size_t link : model_.links(proxy_.mapToSource(index))) links.insert(link);
  }
  return {links.begin(), links.end()};
}

std::vector<int> BranchPanel::chosenBranches() const {
  std::set<int> branches;
  for (const std::size_t link : chosenLinks()) branches.insert(model_.branchAt(model_.branchOfLink(link)));
  return {branches.begin(), branches.end()};
}

void BranchPanel::clickLink(std::size_t link, Qt::KeyboardModifiers modifiers) {
  clickRow(model_.branchOfLink(link), modifiers);
}

void BranchPanel::clickSingle(std::size_t link, Qt::KeyboardModifiers modifiers) {
  clickRow(model_.indexOfLink(link), modifiers);
}

void BranchPanel::chooseLinks(const std::vector<std::size_t>& links, bool add) {
  if (!search_->text().isEmpty()) search_->clear();
  const std::set<std::size_t> wanted(links.begin(), links.end());
  QItemSelection selection;
  std::set<int> whole, looked;
  for (const std::size_t link : wanted) {
    const QModelIndex branch = model_.branchOfLink(link);
    const int number = model_.branchAt(branch);
    if (number >= 0 && looked.insert(number).second) {
      const std::vector<std::size_t> all = model_.links(branch);
      if (std::all_of(all.begin(), all.end(), [&](std::size_t l) { return wanted.contains(l); })) whole.insert(number);
      if (whole.contains(number)) {
        const QModelIndex row = proxy_.mapFromSource(branch);
        selection.select(row, row.siblingAtColumn(BranchModel::ColumnCount - 1));
      }
    }
    if (whole.contains(number)) continue;
    const QModelIndex row = proxy_.mapFromSource(model_.indexOfLink(link));
    if (row.isValid()) selection.select(row, row.siblingAtColumn(BranchModel::ColumnCount - 1));
  }
  view_->selectionModel()->select(selection, add ? QItemSelectionModel::Select : QItemSelectionModel::ClearAndSelect);
}

void BranchPanel::clickRow(const QModelIndex& branch, Qt::KeyboardModifiers modifiers) {
  if (!branch.isValid()) return;
  QModelIndex index = proxy_.mapFromSource(branch);
  if (!index.isValid()) {  // hidden by the search, which has done its work then
    search_->clear();
    index = proxy_.mapFromSource(branch);
  }
  const QItemSelectionModel::SelectionFlags how = modifiers & Qt::ControlModifier ? QItemSelectionModel::Toggle
                                                  : modifiers & Qt::ShiftModifier ? QItemSelectionModel::Select
                                                                                  : QItemSelectionModel::ClearAndSelect;
  view_->selectionModel()->select(index, how | QItemSelectionModel::Rows);
  view_->selectionModel()->setCurrentIndex(index, QItemSelectionModel::NoUpdate);
  view_->scrollTo(index);
}

void BranchPanel::clear() { view_->clearSelection(); }

void BranchPanel::chooseAll() {
  QItemSelection all;
  for (int branch = 0; model_.branchIndex(branch).isValid(); ++branch) {
    const QModelIndex index = proxy_.mapFromSource(model_.branchIndex(branch));
    if (index.isValid()) all.select(index, index.siblingAtColumn(BranchModel::ColumnCount - 1));
  }
  view_->selectionModel()->select(all, QItemSelectionModel::ClearAndSelect);
}

}  // namespace windfall::widgets
