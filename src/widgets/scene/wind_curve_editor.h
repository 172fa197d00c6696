// The wind's strength and direction over time as two curves whose points are dragged.
#pragma once

#include <QWidget>
#include <vector>

#include "sim/settings.h"

namespace windfall::widgets {

/// Upper lane: strength, times the mean speed; lower lane: turn, degrees from the wind's direction. A double click on
/// an empty place adds a point, a drag moves it (Shift keeps its time), Delete or a right click removes it, arrow keys
/// nudge the chosen one. A recorded wind is shown but not edited.
class WindCurveEditor : public QWidget {
  Q_OBJECT
 public:
  explicit WindCurveEditor(QWidget* parent = nullptr);

  void show(const sim::WindSettings& wind);
  /// Where the simulation is, s.
  void setTime(double time);
  int chosenPoint() const { return chosen_; }
  /// Where a point of the upper (strength) or lower (turn) lane stands, px.
  QPointF pointPlace(std::size_t index, bool turn) const;
  /// Where a time and a value stand in a lane, px.
  QPointF place(double time, double value, bool turn) const;
  QSize sizeHint() const override { return {240, 148}; }
  QSize minimumSizeHint() const override { return {160, 120}; }

 signals:
  /// `gesture` is the same through one drag.
  void edited(const std::vector<windfall::sim::WindKey>& curve, const QString& text, const QString& gesture);

 protected:
  void paintEvent(QPaintEvent*) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  bool event(QEvent* event) override;

 private:
  struct Grip {
    int point = -1;
    bool turn = false;
  };
  QRectF lane(bool turn) const;
  double span() const;
  double strongest() const;
  Grip gripAt(QPointF position) const;
  void apply(const std::vector<sim::WindKey>& curve, const QString& text, bool ends);
  void removePoint(int index);
  void paintLane(QPainter& painter, bool turn) const;
  bool isEditable() const { return wind_.course == sim::WindCourse::Curve; }

  sim::WindSettings wind_;
  double time_ = 0;
  int chosen_ = -1;
  Grip drag_;
  double frozenSpan_ = 0, frozenTop_ = 0;  ///< scales stay while a point is dragged
  bool dragging_ = false;
  quint64 gesture_ = 0;
};

}  // namespace windfall::widgets
