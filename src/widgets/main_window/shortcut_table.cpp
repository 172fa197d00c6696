#include "widgets/main_window/shortcut_table.h"

#include <QSettings>
#include <algorithm>
#include <utility>

namespace windfall::widgets {

namespace {

QString plain(QString text) { return text.remove(QLatin1Char('&')); }

QString settingOf(const ShortcutTable::Row& row) {
  return QStringLiteral("shortcuts/") + row.workspace + QLatin1Char('.') +
         (row.action->objectName().isEmpty() ? plain(row.action->text()) : row.action->objectName());
}

}  // namespace

void ShortcutTable::add(QAction* action, const QString& place, const QString& workspace) {
  if (find(action)) return;
  Row row{action, workspace, plain(place), action->shortcuts(), action->shortcuts()};
  const QVariant chosen = QSettings().value(settingOf(row));
  if (chosen.isValid()) {
    row.keys = QKeySequence::listFromString(chosen.toString());
    row.keys.removeAll(QKeySequence());
    action->setShortcuts(row.keys);
  }
  rows_.push_back(std::move(row));
}

const ShortcutTable::Row* ShortcutTable::find(const QAction* action) const {
  const auto found = std::ranges::find_if(rows_, [&](const Row& row) { return row.action == action; });
  return found == rows_.end() ? nullptr : &*found;
}

ShortcutTable::Row* ShortcutTable::find(const QAction* action) {
  return const_cast<Row*>(std::as_const(*this).find(action));
}

ShortcutTable::Keys ShortcutTable::of(const QAction* action) const {
  const Row* row = find(action);
  return row ? row->keys : Keys();
}

QString ShortcutTable::workspaceOf(const QAction* action) const {
  const Row* row = find(action);
  return row ? row->workspace : QString();
}

QAction* ShortcutTable::holder(const QKeySequence& key, const QAction* action) const {
  const QString workspace = workspaceOf(action);
  for (const Row& row : rows_) {
    if (!row.action || row.action == action || !row.keys.contains(key)) continue;
    if (row.workspace.isEmpty() || workspace.isEmpty() || row.workspace == workspace) return row.action;
  }
  return nullptr;
}

void ShortcutTable::store(Row& row, const Keys& keys) {
  if (row.keys == keys) return;
  row.keys = keys;
  if (keys == row.defaults) {
    QSettings().remove(settingOf(row));
  } else {
    QSettings().setValue(settingOf(row), QKeySequence::listToString(keys));
  }
  emit changed(row.action);
}

void ShortcutTable::set(QAction* action, const Keys& keys) {
  for (const QKeySequence& key : keys) {
    while (QAction* other = holder(key, action)) {
      Keys left = of(other);
      left.removeAll(key);
      store(*find(other), left);
    }
  }
  if (Row* row = find(action)) store(*row, keys);
}

void ShortcutTable::reset(QAction* action) {
  if (const Row* row = find(action)) set(action, Keys(row->defaults));
}

void ShortcutTable::resetAll() {
  for (Row& row : rows_) {
    if (row.action) store(row, row.defaults);
  }
}

}  // namespace windfall::widgets
