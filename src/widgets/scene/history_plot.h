// A short history of a few numbers beside each other, on one scale.
#pragma once

#include <QStringList>
#include <QWidget>
#include <deque>
#include <vector>

namespace windfall::widgets {

/// Cells with name, newest value, share of the sum, and a small plot of the last values.
class HistoryPlot : public QWidget {
  Q_OBJECT
 public:
  /// `names` are translated; `unit` follows each value.
  HistoryPlot(const QStringList& names, const QString& unit, QWidget* parent = nullptr);

  /// One value a name.
  void add(const std::vector<double>& values);
  void clear();
  /// Mean of the newest values, so that the digits can be read.
  double shown(std::size_t cell) const;
  /// Part of the sum of all cells, 0..1.
  double share(std::size_t cell) const;
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;

 protected:
  void paintEvent(QPaintEvent*) override;

 private:
  void paintCell(QPainter& painter, const QRectF& cell, std::size_t index, double scale) const;

  QStringList names_;
  QString unit_;
  std::deque<std::vector<double>> history_;
};

}  // namespace windfall::widgets
