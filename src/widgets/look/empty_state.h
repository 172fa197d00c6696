// What an empty canvas shows: what to do next, as buttons.
#pragma once

#include <QWidget>

class QLabel;
class QPushButton;
class QVBoxLayout;

namespace windfall::widgets {

/// A large icon, a line of what this place is for, buttons. Fills its parent's middle.
class EmptyState : public QWidget {
  Q_OBJECT
 public:
  EmptyState(const QString& iconName, const QString& title, const QString& text, QWidget* parent = nullptr);
  QPushButton* addButton(const QString& text, const QString& iconName = {}, bool primary = false);
  /// Links below the buttons, one a line (recent files).
  void setLinks(const QString& title, const QStringList& texts, const QStringList& targets);

 signals:
  void linkActivated(const QString& target);

 protected:
  void paintEvent(QPaintEvent*) override;
  void changeEvent(QEvent* event) override;

 private:
  void updateIcon();

  QString iconName_;
  QLabel *icon_, *links_;
  QVBoxLayout* buttons_;
};

}  // namespace windfall::widgets
