#include "widgets/main_window/shortcut_dialog.h"

#include <QDialogButtonBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QKeySequenceEdit>
#include <QLabel>
#include <QLineEdit>
#include <QMap>
#include <QPushButton>
#include <QTreeWidget>
#include <QVBoxLayout>

#include "widgets/look/look.h"

namespace windfall::widgets {

namespace {
QString plain(QString text) { return text.remove(QLatin1Char('&')); }
}  // namespace

ShortcutDialog::ShortcutDialog(ShortcutTable& table, QWidget* parent)
    : QDialog(parent),
      table_(table),
      search_(new QLineEdit(this)),
      list_(new QTreeWidget(this)),
      keys_(new QKeySequenceEdit(this)),
      note_(new QLabel(this)),
      clear_(new QPushButton(tr("No Key"), this)),
      reset_(new QPushButton(tr("Reset"), this)) {
  setWindowTitle(tr("Keyboard Shortcuts"));
  resize(560, 600);
  auto* column = new QVBoxLayout(this);
  column->setSpacing(2 * kGrid);
  search_->setPlaceholderText(tr("Find an action or a key…"));
  search_->setClearButtonEnabled(true);
  column->addWidget(search_);
  list_->setHeaderLabels({tr("Action"), tr("Keys")});
  list_->header()->setStretchLastSection(false);
  list_->header()->setSectionResizeMode(0, QHeaderView::Stretch);
  list_->setUniformRowHeights(true);
  column->addWidget(list_, 1);
  auto* row = new QHBoxLayout;
  auto* label = new QLabel(tr("New &key"), this);
  label->setBuddy(keys_);
  clear_->setToolTip(tr("The action keeps its place in the menu, without a key"));
  reset_->setToolTip(tr("Back to the key that Windfall came with"));
  row->addWidget(label);
  row->addWidget(keys_, 1);
  row->addWidget(clear_);
  row->addWidget(reset_);
  column->addLayout(row);
  note_->setProperty("hint", true);
  column->addWidget(note_);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close | QDialogButtonBox::RestoreDefaults, this);
  column->addWidget(buttons);

  fill();
  choose(nullptr);
  connect(search_, &QLineEdit::textChanged, this, &ShortcutDialog::filter);
  connect(list_, &QTreeWidget::currentItemChanged, this, &ShortcutDialog::choose);
  connect(keys_, &QKeySequenceEdit::editingFinished, this, &ShortcutDialog::assign);
  connect(clear_, &QPushButton::clicked, this, [this] { table_.set(chosen(), {}); });
  connect(reset_, &QPushButton::clicked, this, [this] { table_.reset(chosen()); });
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  connect(buttons->button(QDialogButtonBox::RestoreDefaults), &QPushButton::clicked, &table_, &ShortcutTable::resetAll);
  connect(&table_, &ShortcutTable::changed, this, [this](QAction* action) {
    for (QTreeWidgetItemIterator it(list_); *it; ++it) {
      if ((*it)->data(0, Qt::UserRole).value<QAction*>() != action) continue;
      (*it)->setText(1, QKeySequence::listToString(table_.of(action), QKeySequence::NativeText));
    }
    choose(list_->currentItem());
  });
}

void ShortcutDialog::fill() {
  QMap<QString, QTreeWidgetItem*> places;
  for (const ShortcutTable::Row& row : table_.rows()) {
    if (!row.action) continue;
    QTreeWidgetItem*& place = places[row.place];
    if (!place) {
      place = new QTreeWidgetItem(list_, {row.place});
      place->setFlags(Qt::ItemIsEnabled);
    }
    auto* item = new QTreeWidgetItem(
        place, {plain(row.action->text()), QKeySequence::listToString(row.keys, QKeySequence::NativeText)});
    item->setIcon(0, row.action->icon());
    item->setData(0, Qt::UserRole, QVariant::fromValue(row.action.data()));
  }
  list_->expandAll();
}

void ShortcutDialog::filter(const QString& text) {
  for (int p = 0; p < list_->topLevelItemCount(); ++p) {
    QTreeWidgetItem* place = list_->topLevelItem(p);
    bool any = false;
    for (int i = 0; i < place->childCount(); ++i) {
      QTreeWidgetItem* item = place->child(i);
      const bool fits =
          item->text(0).contains(text, Qt::CaseInsensitive) || item->text(1).contains(text, Qt::CaseInsensitive);
      item->setHidden(!fits);
      any = any || fits;
    }
    place->setHidden(!any);
  }
}

QAction* ShortcutDialog::chosen() const {
  const QTreeWidgetItem* item = list_->currentItem();
  return item ? item->data(0, Qt::UserRole).value<QAction*>() : nullptr;
}

void ShortcutDialog::choose(QTreeWidgetItem*) {
  const QAction* action = chosen();
  for (QWidget* widget : {static_cast<QWidget*>(keys_), static_cast<QWidget*>(clear_), static_cast<QWidget*>(reset_)}) {
    widget->setEnabled(action);
  }
  const QSignalBlocker quiet(keys_);
  keys_->setKeySequence(action ? table_.of(action).value(0) : QKeySequence());
  note_->setText(action ? tr("Click the field and press the keys.") : tr("Choose an action."));
}

void ShortcutDialog::assign() {
  QAction* action = chosen();
  const QKeySequence key = keys_->keySequence();
  if (!action || key.isEmpty() || table_.of(action).contains(key)) return;
  const QAction* before = table_.holder(key, action);
  const QString taken = before ? plain(before->text()) : QString();
  table_.set(action, {key});
  note_->setText(
      before ? tr("%1 was the key of “%2”, which has it no more.").arg(key.toString(QKeySequence::NativeText), taken)
             : tr("%1 is the key of “%2” now.").arg(key.toString(QKeySequence::NativeText), plain(action->text())));
}

}  // namespace windfall::widgets
