// The text of an L-system, with the line marked that is wrong.
#pragma once

#include <QTimer>
#include <QWidget>

class QLabel;
class QPlainTextEdit;

namespace windfall::widgets {

class RulesEditor : public QWidget {
  Q_OBJECT
 public:
  explicit RulesEditor(QWidget* parent = nullptr);

  /// Shows a text; what is being typed stays where it is the same.
  void show(const QString& rules);
  QPlainTextEdit* text() const { return text_; }
  /// "2:8: '(' is never closed", or how large the plant is; and the line that is marked, from 1, 0: none.
  QString problem() const { return problem_; }
  int markedLine() const { return marked_; }

 signals:
  /// A pause in typing; `merge` is one for a stretch of typing.
  void edited(const QString& rules, const QString& merge);

 private:
  void check();
  void commit();

  QPlainTextEdit* text_;
  QLabel* state_;
  QTimer pause_;
  QString problem_, shown_;
  int marked_ = 0;
  quint64 stretch_ = 0;
};

}  // namespace windfall::widgets
