// Which keys run which action: the program's defaults, and what the artist changed.
#pragma once

#include <QAction>
#include <QKeySequence>
#include <QList>
#include <QObject>
#include <QPointer>
#include <QString>
#include <vector>

namespace windfall::widgets {

/// Changed keys are kept in the settings by the action's place and text. An action of one workspace may share its keys
/// with one of another workspace, but never with a global one.
class ShortcutTable : public QObject {
  Q_OBJECT
 public:
  using Keys = QList<QKeySequence>;
  struct Row {
    QPointer<QAction> action;
    QString workspace;  ///< its id; empty: works everywhere
    QString place;      ///< the menu it stands in, as shown
    Keys defaults, keys;
  };
  using QObject::QObject;

  /// The keys that the action has now become its defaults; those that were chosen for it replace them.
  void add(QAction* action, const QString& place, const QString& workspace = {});
  const std::vector<Row>& rows() const { return rows_; }
  /// Its keys; none for an action that was never added.
  Keys of(const QAction* action) const;
  /// Empty: it works everywhere.
  QString workspaceOf(const QAction* action) const;

  /// The action, other than `action`, that already has this key where `action` works; null: it is free.
  QAction* holder(const QKeySequence& key, const QAction* action) const;
  /// Gives an action its keys and takes them from whoever had them.
  void set(QAction* action, const Keys& keys);
  void reset(QAction* action);
  void resetAll();

 signals:
  /// `of(action)` is another one than before.
  void changed(QAction* action);

 private:
  const Row* find(const QAction* action) const;
  Row* find(const QAction* action);
  void store(Row& row, const Keys& keys);

  std::vector<Row> rows_;
};

}  // namespace windfall::widgets
