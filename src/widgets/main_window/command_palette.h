// Finds any action by a few letters of its name.
#pragma once

#include <QFrame>
#include <QPointer>

class QAction;
class QLineEdit;
class QListWidget;

namespace windfall::widgets {

/// Opens over the middle of its parent; Up and Down choose, Return runs, Esc closes.
class CommandPalette : public QFrame {
  Q_OBJECT
 public:
  explicit CommandPalette(QWidget* parent);
  void open(const QList<QAction*>& actions);
  QLineEdit* input() const { return input_; }
  QListWidget* list() const { return list_; }

  /// How well `pattern` fits: every letter in order, better at the start of words and in runs; below 0: not at all.
  static int score(const QString& pattern, const QString& text);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void refresh();
  void run();

  QLineEdit* input_;
  QListWidget* list_;
  QList<QPointer<QAction>> actions_;
};

}  // namespace windfall::widgets
