// A direction as a small dial with its number.
#pragma once

#include "widgets/fields/field.h"

namespace windfall::widgets {

class NumberBox;

/// Turns by dragging; Shift snaps to 15 degrees. A compass: 0 is up (north, -Z), clockwise.
class Dial : public QWidget {
  Q_OBJECT
 public:
  explicit Dial(QWidget* parent = nullptr);
  double angle() const { return angle_; }
  void setAngle(double degrees);
  void setMixed(bool mixed);
  /// Letters at the four sides.
  void setCompass(bool compass);
  QSize sizeHint() const override { return {56, 56}; }

 signals:
  void turned(double degrees);
  void released();

 protected:
  void paintEvent(QPaintEvent*) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;

 private:
  void turn(const QPointF& position, bool snap);

  double angle_ = 0;
  bool mixed_ = false, compass_ = false;
};

/// Degrees 0..360, clockwise from north.
class DialField : public Field {
  Q_OBJECT
 public:
  DialField(const QString& label, double defaultValue, bool compass, QWidget* parent = nullptr);
  double value() const { return value_; }
  void setValue(double degrees);
  void setMixed() override;
  Dial* dial() const { return dial_; }
  NumberBox* box() const { return box_; }

 signals:
  void edited(double degrees, bool finished);

 protected:
  void reset() override;

 private:
  Dial* dial_;
  NumberBox* box_;
  double value_ = 0, default_;
};

}  // namespace windfall::widgets
