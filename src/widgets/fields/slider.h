// A slim slider: a filled groove with a round handle.
#pragma once

#include <QWidget>

namespace windfall::widgets {

/// Position 0..1. A click goes there at once; Shift drags ten times finer; the wheel works only when it has the focus.
class Slider : public QWidget {
  Q_OBJECT
 public:
  explicit Slider(QWidget* parent = nullptr);
  double position() const { return position_; }
  void setPosition(double position);
  /// Distance of an arrow key or a wheel notch.
  void setStep(double step) { step_ = step; }
  /// No handle: the values of several things differ.
  void setMixed(bool mixed);
  QSize sizeHint() const override { return {96, 20}; }
  QSize minimumSizeHint() const override { return {32, 20}; }

 signals:
  void dragged(double position);
  /// The pointer was released, or a key or the wheel moved it.
  void released();

 protected:
  void paintEvent(QPaintEvent*) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void enterEvent(QEnterEvent*) override { update(); }
  void leaveEvent(QEvent*) override { update(); }

 private:
  void moveTo(double position);

  double position_ = 0, step_ = 0.01;
  double lastX_ = 0;
  bool mixed_ = false, dragging_ = false;
};

}  // namespace windfall::widgets
