// The message area: what went wrong or well, and where.
#pragma once

#include <QWidget>
#include <functional>

class QLabel;
class QPushButton;
class QTimer;
class QToolButton;

namespace windfall::widgets {

/// One line with its level's icon. An error stays until it is dismissed or another message comes; a note goes by
/// itself.
class MessageBar : public QWidget {
  Q_OBJECT
 public:
  explicit MessageBar(QWidget* parent = nullptr);
  void showMessage(const QString& text, bool isError);
  /// A note with something to do about it; stays until it is answered or dismissed.
  void offer(const QString& text, const QString& button, std::function<void()> accept);
  void dismiss();
  QPushButton* offerButton() const { return button_; }
  /// The whole text, also where the line is cut; empty when nothing is shown.
  QString text() const { return text_; }
  bool isError() const { return error_; }

 protected:
  void resizeEvent(QResizeEvent*) override;
  void changeEvent(QEvent* event) override;

 private:
  void layOut();

  QString text_;
  bool error_ = false;
  QLabel *icon_, *label_;
  QToolButton* close_;
  QPushButton* button_;
  std::function<void()> accept_;
  QTimer* fade_;
};

}  // namespace windfall::widgets
