// How the tip of a chosen branch moves, and how often.
#pragma once

#include <QWidget>
#include <deque>

#include "kernels/math.h"

namespace windfall::widgets {

/// Displacement from rest along the direction in which the tip moves most, over the last seconds.
class MotionPlot : public QWidget {
  Q_OBJECT
 public:
  explicit MotionPlot(QWidget* parent = nullptr);

  /// Another branch, or the start: forgets the record. An empty name: no branch is chosen.
  void start(const QString& branch);
  /// Displacement of the tip from rest, m, at `time` s. Time that goes back starts anew.
  void add(double time, vec3 displacement);
  /// Hz; 0 while the record is too short.
  double frequency() const { return frequency_; }
  std::size_t sampleCount() const { return record_.size(); }
  QSize sizeHint() const override { return {420, 64}; }
  QSize minimumSizeHint() const override { return {240, 44}; }

 protected:
  void paintEvent(QPaintEvent*) override;

 private:
  struct Sample {
    double time;
    vec3 displacement;
  };
  void measure();

  QString branch_;
  std::deque<Sample> record_;
  vec3 axis_{1, 0, 0};
  vec3 mean_{0};
  double frequency_ = 0;
  int unmeasured_ = 0;
};

}  // namespace windfall::widgets
