// The inspector's body: groups of rows that fold, in a scroll area.
#pragma once

#include <QScrollArea>
#include <QString>
#include <QWidget>

class QPushButton;
class QToolButton;
class QVBoxLayout;

namespace windfall::widgets {

class Field;

/// A titled group; a click on the title folds it.
class FieldGroup : public QWidget {
  Q_OBJECT
 public:
  explicit FieldGroup(const QString& title, QWidget* parent = nullptr);
  /// Adds a row and returns it, so that its signals can be connected at once.
  template <class F>
  F* add(F* field) {
    addWidget(field);
    return field;
  }
  void addWidget(QWidget* widget);
  /// A wide button below the rows.
  QPushButton* addButton(const QString& text, const QString& iconName = {});
  void setFolded(bool folded);
  bool isFolded() const { return folded_; }
  QToolButton* header() const { return header_; }

 signals:
  void foldedChanged(bool folded);

 private:
  QToolButton* header_;
  QWidget* body_;
  QVBoxLayout* rows_;
  bool folded_ = false;
};

/// Groups below each other. Which are folded is remembered (QSettings) by `id`.
class FieldPanel : public QScrollArea {
  Q_OBJECT
 public:
  explicit FieldPanel(const QString& id, QWidget* parent = nullptr);
  /// `groupId` is stable and not shown.
  FieldGroup* addGroup(const QString& groupId, const QString& title);
  /// Something between or below the groups.
  void addWidget(QWidget* widget);

 private:
  QString id_;
  QVBoxLayout* column_;
};

}  // namespace windfall::widgets
