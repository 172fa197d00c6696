// One row of an inspector: label, editor, reset. What all kinds of rows share.
#pragma once

#include <QString>
#include <QWidget>

class QHBoxLayout;
class QToolButton;

namespace windfall::widgets {

/// A name cut with an ellipsis where there is no room; the whole is its tool tip then.
class ElidedLabel : public QWidget {
  Q_OBJECT
 public:
  explicit ElidedLabel(const QString& text, QWidget* parent = nullptr);
  void setText(const QString& text);
  QString text() const { return text_; }
  QSize sizeHint() const override;

 protected:
  void paintEvent(QPaintEvent*) override;

 private:
  QString text_;
};

/// A row. Each kind adds a signal `edited(value, finished)`: `finished` is false while the pointer is still down, so
/// slow work can wait; the value should be applied at once all the same, with `gesture()` as (part of) the merge key.
/// `setValue` never emits. A mixed row shows the values of several things that differ.
class Field : public QWidget {
  Q_OBJECT
 public:
  explicit Field(const QString& label, QWidget* parent = nullptr);

  QString label() const { return label_->text(); }
  /// The same through one drag and new for the next: edits with it become one undo step. Contains the field's label.
  QString gesture() const;
  bool isMixed() const { return mixed_; }
  /// Shows a dash instead of the value until one is set.
  virtual void setMixed();
  /// The button that brings the default back; shown when the value differs from it.
  QToolButton* resetButton() const { return reset_; }

  /// Widths that make the rows of all groups line up.
  static constexpr int kLabelWidth = 104;
  static constexpr int kNumberWidth = 80;
  static constexpr int kRowHeight = 24;

 protected:
  QHBoxLayout* row() const { return row_; }
  /// Called by the kinds after a value was set or edited.
  void showState(bool isDefault);
  void clearMixed() { mixed_ = false; }
  void finishGesture() { ++gesture_; }
  /// Adds the reset button at the end of the row.
  void closeRow();
  virtual void reset() {}

 private:
  ElidedLabel* label_;
  QHBoxLayout* row_;
  QToolButton* reset_;
  bool mixed_ = false;
  quint64 gesture_;
};

}  // namespace windfall::widgets
