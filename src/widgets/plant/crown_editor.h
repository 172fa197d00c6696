// The outline of a crown, drawn by the artist.
#pragma once

#include <QWidget>
#include <vector>

#include "model/plant/grow/settings.h"

namespace windfall::widgets {

/// Shows the crown from the side. Drag a point; a click beside the outline adds one, a right click or Delete takes one
/// away, a double click goes back to the formula. Both sides can differ.
class CrownEditor : public QWidget {
  Q_OBJECT
 public:
  explicit CrownEditor(QWidget* parent = nullptr);
  void show(const model::CrownSettings& crown);
  QSize sizeHint() const override { return {200, 180}; }
  /// Where a point of the outline lies in the widget.
  QPointF toWidget(QPointF point) const;
  const std::vector<QPointF>& points() const { return points_; }

 signals:
  /// The outline as CrownSettings::profile; empty: the formula again.
  void edited(const std::vector<QPointF>& profile, const QString& merge);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  QPointF fromWidget(QPointF place) const;
  int nearest(QPointF place) const;
  void remove(int index);
  void tell();

  model::CrownSettings crown_;
  std::vector<QPointF> points_;  ///< what is drawn, or the formula in a few points
  int grabbed_ = -1, chosen_ = -1;
  quint64 gesture_ = 0;
};

}  // namespace windfall::widgets
