#include "widgets/main_window/asset_tree.h"

#include <QAction>
#include <QDropEvent>
#include <QHeaderView>
#include <QMimeData>
#include <QStyledItemDelegate>
#include <QToolButton>

#include "widgets/look/icon.h"

namespace windfall::widgets {

using model::Aspect;
using model::AssetId;

namespace {
constexpr int kId = Qt::UserRole;
constexpr int kKind = Qt::UserRole + 1;
constexpr int kHangs = 3;  // kind of the rows under a plant: kId is the leaf's

AssetId idOf(const QTreeWidgetItem* item) { return {item ? item->data(0, kId).toULongLong() : 0}; }
int kindOf(const QTreeWidgetItem* item) { return item ? item->data(0, kKind).toInt() : -1; }

/// Unfolded rows would show their icon as if it were switched on.
class RowDelegate : public QStyledItemDelegate {
 public:
  using QStyledItemDelegate::QStyledItemDelegate;

 protected:
  void initStyleOption(QStyleOptionViewItem* option, const QModelIndex& index) const override {
    QStyledItemDelegate::initStyleOption(option, index);
    option->state &= ~QStyle::State_Open;
  }
};
}  // namespace

AssetTree::AssetTree(model::Document& document, QWidget* parent) : QTreeWidget(parent), document_(document) {
  setColumnCount(2);
  setHeaderHidden(true);
  header()->setStretchLastSection(false);
  header()->setSectionResizeMode(0, QHeaderView::Stretch);
  header()->setSectionResizeMode(1, QHeaderView::Fixed);
  header()->resizeSection(1, 28);
  setIndentation(16);
  setIconSize({16, 16});
  setUniformRowHeights(true);
  setItemDelegate(new RowDelegate(this));
  setEditTriggers(QAbstractItemView::EditKeyPressed);
  setDragEnabled(true);
  setAcceptDrops(true);
  setDropIndicatorShown(true);
  setDragDropMode(QAbstractItemView::DragDrop);
  setDefaultDropAction(Qt::CopyAction);
  setContextMenuPolicy(Qt::ActionsContextMenu);
  setMinimumHeight(120);

  const std::pair<QString, QString> groups[] = {{tr("Leaves"), tr("Open a leaf photo…")},
                                                {tr("Plants"), tr("Import or grow a plant…")},
                                                {tr("Scene"), tr("Place a tree")}};
  for (int kind = 0; kind < 3; ++kind) {
    auto* group = groups_[kind] = new QTreeWidgetItem(this, {groups[kind].first});
    group->setData(0, kKind, -1);
    group->setFlags(Qt::ItemIsEnabled);
    QFont font = this->font();
    font.setWeight(QFont::DemiBold);
    group->setFont(0, font);
    auto* add = new QToolButton(this);
    add->setObjectName(QStringLiteral("add%1").arg(kind));
    add->setIcon(icon(QStringLiteral("add")));
    add->setIconSize({14, 14});
    add->setFixedSize(22, 22);
    add->setToolTip(groups[kind].second);
    add->setFocusPolicy(Qt::NoFocus);
    connect(add, &QToolButton::clicked, this, [this, kind] { emit addRequested(AssetKind(kind)); });
    setItemWidget(group, 1, add);
    group->setExpanded(true);
  }

  const auto addAction = [this](const QString& text, const QString& iconName, const QKeySequence& keys) {
    auto* action = new QAction(icon(iconName), text, this);
    action->setShortcut(keys);
    action->setShortcutContext(Qt::WidgetWithChildrenShortcut);
    QWidget::addAction(action);
    return action;
  };
  rename_ = addAction(tr("Rename"), QStringLiteral("rename"), Qt::Key_F2);
  duplicate_ = addAction(tr("Duplicate"), QStringLiteral("duplicate"), QKeySequence(QStringLiteral("Ctrl+D")));
  delete_ = addAction(tr("Delete"), QStringLiteral("delete"), QKeySequence::Delete);
  connect(rename_, &QAction::triggered, this, [this] {
    if (currentItem()) editItem(currentItem(), 0);
  });
  connect(duplicate_, &QAction::triggered, this, [this] {
    const AssetId copy = document_.duplicate(current());
    if (copy) select(copy);
  });
  connect(delete_, &QAction::triggered, this, [this] { document_.remove(current()); });

  connect(this, &QTreeWidget::itemChanged, this, [this](QTreeWidgetItem* item) {
    if (!rebuilding_) whenEdited(item);
  });
  connect(this, &QTreeWidget::currentItemChanged, this, [this](QTreeWidgetItem* item) {
    updateActions();
    if (rebuilding_ || !idOf(item) || kindOf(item) == kHangs) return;
    emit chosen(idOf(item), AssetKind(kindOf(item)));
  });
  connect(this, &QTreeWidget::itemDoubleClicked, this, [this](QTreeWidgetItem* item) {
    if (!idOf(item)) return;
    emit opened(idOf(item), kindOf(item) == kHangs ? AssetKind::Leaf : AssetKind(kindOf(item)));
  });
  connect(&document_, &model::Document::changed, this, [this](const model::Change& change) {
    if (change.aspect == Aspect::Everything || change.aspect == Aspect::Assets || change.aspect == Aspect::SceneTrees ||
        change.aspect == Aspect::PlantLeaves) {
      rebuild();
    }
  });
  rebuild();
}

AssetId AssetTree::current() const {
  const QTreeWidgetItem* item = currentItem();
  return kindOf(item) == kHangs ? idOf(item->parent()) : idOf(item);
}

QTreeWidgetItem* AssetTree::itemOf(AssetId asset) const {
  for (const QTreeWidgetItem* group : groups_) {
    for (int i = 0; i < group->childCount(); ++i) {
      if (asset && idOf(group->child(i)) == asset) return group->child(i);
    }
  }
  return nullptr;
}

QTreeWidgetItem* AssetTree::leafRow(AssetId plant, AssetId leaf) const {
  const QTreeWidgetItem* item = itemOf(plant);
  for (int i = 0; item && i < item->childCount(); ++i) {
    if (idOf(item->child(i)) == leaf) return item->child(i);
  }
  return nullptr;
}

void AssetTree::select(AssetId asset) {
  if (QTreeWidgetItem* item = itemOf(asset)) setCurrentItem(item);
}

void AssetTree::addAsset(AssetKind kind, AssetId id, const QString& name) {
  static const QString icons[] = {QStringLiteral("leaf"), QStringLiteral("plant"), QStringLiteral("pin")};
  auto* item = new QTreeWidgetItem(groups_[int(kind)], {name});
  item->setData(0, kId, id.value);
  item->setData(0, kKind, int(kind));
  item->setIcon(0, icon(icons[int(kind)]));
  Qt::ItemFlags flags = Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsEditable;
  if (kind == AssetKind::Leaf) flags |= Qt::ItemIsDragEnabled;
  if (kind == AssetKind::Plant) flags |= Qt::ItemIsDropEnabled;
  item->setFlags(flags);
}

void AssetTree::rebuild() {
  rebuilding_ = true;
  const AssetId before = current();
  std::map<quint64, bool> folded;
  for (int i = 0; i < groupOf(AssetKind::Plant)->childCount(); ++i) {
    const QTreeWidgetItem* plant = groupOf(AssetKind::Plant)->child(i);
    folded[idOf(plant).value] = !plant->isExpanded();
  }
  for (QTreeWidgetItem* group : groups_) qDeleteAll(group->takeChildren());
  const model::Project& project = document_.project();
  for (const model::Leaf& leaf : project.leaves) addAsset(AssetKind::Leaf, leaf.id, leaf.name);
  for (const model::Plant& plant : project.plants) {
    addAsset(AssetKind::Plant, plant.id, plant.name);
    QTreeWidgetItem* parent = groupOf(AssetKind::Plant)->child(groupOf(AssetKind::Plant)->childCount() - 1);
    for (const model::Leaf& leaf : project.leaves) {
      auto* row = new QTreeWidgetItem(parent, {leaf.name});
      row->setData(0, kId, leaf.id.value);
      row->setData(0, kKind, kHangs);
      row->setFlags(Qt::ItemIsEnabled | Qt::ItemIsUserCheckable);
      const bool hangs = std::find(plant.leaves.begin(), plant.leaves.end(), leaf.id) != plant.leaves.end();
      row->setCheckState(0, hangs ? Qt::Checked : Qt::Unchecked);
      row->setToolTip(0, tr("Leaves of %1 hang on %2").arg(leaf.name, plant.name));
    }
    parent->setExpanded(!folded[plant.id.value]);
  }
  for (const model::TreePlacement& tree : project.scene.trees) addAsset(AssetKind::Tree, tree.id, tree.name);
  for (QTreeWidgetItem* group : groups_) group->setExpanded(true);
  if (QTreeWidgetItem* item = itemOf(before)) setCurrentItem(item);
  rebuilding_ = false;
  updateActions();
}

void AssetTree::updateActions() {
  for (QAction* action : {rename_, duplicate_, delete_}) action->setEnabled(bool(current()));
}

void AssetTree::whenEdited(QTreeWidgetItem* item) {
  // Renaming rebuilds the list, which deletes the item that is being edited: first let the editor close.
  const AssetId id = idOf(item);
  if (kindOf(item) == kHangs) {
    const AssetId plant = idOf(item->parent());
    const bool on = item->checkState(0) == Qt::Checked;
    QMetaObject::invokeMethod(
        this, [this, id, plant, on] { hang(id, plant, on); }, Qt::QueuedConnection);
    return;
  }
  const QString name = item->text(0).trimmed();
  QMetaObject::invokeMethod(
      this,
      [this, id, name] {
        if (name.isEmpty()) return rebuild();
        document_.rename(id, name);
        rebuild();
      },
      Qt::QueuedConnection);
}

void AssetTree::hang(AssetId leaf, AssetId plantId, bool on) {
  const model::Plant* plant = document_.project().plant(plantId);
  if (!plant || !document_.project().leaf(leaf)) return;
  std::vector<AssetId> leaves = plant->leaves;
  std::erase(leaves, leaf);
  if (on) leaves.push_back(leaf);
  const QString name = document_.project().leaf(leaf)->name;
  document_.setPlant(plantId, &model::Plant::leaves, leaves, Aspect::PlantLeaves,
                     on ? tr("Hang %1 on %2").arg(name, plant->name) : tr("Take %1 off %2").arg(name, plant->name));
}

void AssetTree::dragMoveEvent(QDragMoveEvent* event) {
  QTreeWidget::dragMoveEvent(event);
  const QTreeWidgetItem* target = itemAt(event->position().toPoint());
  if (event->source() == this && kindOf(currentItem()) == int(AssetKind::Leaf) &&
      (kindOf(target) == int(AssetKind::Plant) || kindOf(target) == kHangs)) {
    event->acceptProposedAction();
  } else {
    event->ignore();
  }
}

void AssetTree::dropEvent(QDropEvent* event) {
  const QTreeWidgetItem* target = itemAt(event->position().toPoint());
  if (kindOf(target) == kHangs) target = target->parent();
  if (event->source() != this || kindOf(currentItem()) != int(AssetKind::Leaf) ||
      kindOf(target) != int(AssetKind::Plant)) {
    return event->ignore();
  }
  // Copied as far as Qt knows: it must not take the leaf's row away.
  event->setDropAction(Qt::CopyAction);
  event->accept();
  const AssetId leaf = current(), plant = idOf(target);
  QMetaObject::invokeMethod(
      this, [this, leaf, plant] { hang(leaf, plant, true); }, Qt::QueuedConnection);
}

void AssetTree::changeEvent(QEvent* event) {
  QTreeWidget::changeEvent(event);
  if (event->type() == QEvent::PaletteChange) viewport()->update();
}

}  // namespace windfall::widgets
