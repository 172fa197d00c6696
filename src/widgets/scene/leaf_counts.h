// How many leaves hang, fly and lie: three numbers over one bar.
#pragma once

#include <QWidget>

#include "sim/engine.h"

namespace windfall::widgets {

class LeafCounts : public QWidget {
  Q_OBJECT
 public:
  explicit LeafCounts(QWidget* parent = nullptr);
  void show(const sim::Statistics& statistics);
  QSize sizeHint() const override { return {280, 64}; }
  QSize minimumSizeHint() const override { return {228, 44}; }

 protected:
  void paintEvent(QPaintEvent*) override;

 private:
  int attached_ = 0, airborne_ = 0, grounded_ = 0;
};

}  // namespace windfall::widgets
