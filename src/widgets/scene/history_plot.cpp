#include "widgets/scene/history_plot.h"

#include <QLocale>
#include <QPainter>
#include <QPainterPath>
#include <numeric>

#include "widgets/look/look.h"

namespace windfall::widgets {
namespace {

constexpr std::size_t kKept = 90;      // values of history
constexpr std::size_t kAveraged = 15;  // of them, for the number shown
constexpr int kCellWidth = 112, kLeastCell = 92, kHeight = 64;

}  // namespace

HistoryPlot::HistoryPlot(const QStringList& names, const QString& unit, QWidget* parent)
    : QWidget(parent), names_(names), unit_(unit) {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
}

QSize HistoryPlot::sizeHint() const { return {kCellWidth * static_cast<int>(names_.size()), kHeight}; }
QSize HistoryPlot::minimumSizeHint() const { return {kLeastCell * static_cast<int>(names_.size()), 44}; }

void HistoryPlot::add(const std::vector<double>& values) {
  history_.push_back(values);
  history_.back().resize(static_cast<std::size_t>(names_.size()));
  if (history_.size() > kKept) history_.pop_front();
  update();
}

void HistoryPlot::clear() {
  history_.clear();
  update();
}

double HistoryPlot::shown(std::size_t cell) const {
  const std::size_t count = std::min(history_.size(), kAveraged);
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) sum += history_[history_.size() - 1 - i][cell];
  return count > 0 ? sum / static_cast<double>(count) : 0;
}

double HistoryPlot::share(std::size_t cell) const {
  double sum = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(names_.size()); ++i) sum += shown(i);
  return sum > 0 ? shown(cell) / sum : 0;
}

void HistoryPlot::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  double scale = 1e-3;
  for (const std::vector<double>& values : history_) {
    scale = std::max(scale, *std::max_element(values.begin(), values.end()));
  }
  const double width = static_cast<double>(this->width()) / static_cast<double>(names_.size());
  for (std::size_t i = 0; i < static_cast<std::size_t>(names_.size()); ++i) {
    paintCell(painter, {static_cast<double>(i) * width, 0, width - 2 * kGrid, static_cast<double>(height())}, i, scale);
  }
  if (history_.size() > 1) return;
  const QRectF empty = QRectF(rect()).adjusted(0, QFontMetricsF(font()).height() + kGrid, -2 * kGrid, -kGrid);
  painter.setPen(Qt::NoPen);
  painter.setBrush(colors(palette()).field);
  painter.drawRoundedRect(empty, 3, 3);
  painter.setPen(colors(palette()).muted);
  painter.drawText(empty, Qt::AlignCenter, tr("Measured while it plays"));
}

void HistoryPlot::paintCell(QPainter& painter, const QRectF& cell, std::size_t index, double scale) const {
  const Colors& look = colors(palette());
  const QFontMetricsF metrics(font());
  const QRectF text(cell.left(), cell.top(), cell.width(), metrics.height());
  painter.setPen(look.muted);
  const QString part = history_.size() < 2 ? QString() : tr("%1 %").arg(QLocale().toString(share(index) * 100, 'f', 0));
  const double room = cell.width() - metrics.horizontalAdvance(part) - kGrid;
  painter.drawText(text, Qt::AlignLeft | Qt::AlignVCenter,
                   metrics.elidedText(names_.at(static_cast<qsizetype>(index)), Qt::ElideRight, room));
  painter.drawText(text, Qt::AlignRight | Qt::AlignVCenter, part);
  const QRectF plot(cell.left(), text.bottom() + kGrid, cell.width(), cell.bottom() - text.bottom() - 2 * kGrid);
  if (plot.height() < kGrid || history_.size() < 2) return;
  painter.setPen(Qt::NoPen);
  painter.setBrush(look.field);
  painter.drawRoundedRect(plot, 3, 3);
  const double step = plot.width() / static_cast<double>(kKept - 1);
  const auto place = [&](std::size_t i) {
    const double fromRight = static_cast<double>(history_.size() - 1 - i) * step;
    return QPointF(plot.right() - fromRight, plot.bottom() - 1 - history_[i][index] / scale * (plot.height() - 3));
  };
  QPainterPath line(place(0));
  for (std::size_t i = 1; i < history_.size(); ++i) line.lineTo(place(i));
  QPainterPath area = line;
  area.lineTo(plot.right(), plot.bottom());
  area.lineTo(place(0).x(), plot.bottom());
  QColor fill = look.accent;
  fill.setAlphaF(0.22f);
  painter.save();
  QPainterPath clip;
  clip.addRoundedRect(plot, 3, 3);
  painter.setClipPath(clip);
  painter.fillPath(area, fill);
  painter.strokePath(line, QPen(look.accent, 1.25));
  painter.restore();
  const double value = shown(index);
  painter.setPen(look.text);
  painter.drawText(plot.adjusted(kGrid, 0, -kGrid, 0), Qt::AlignLeft | Qt::AlignTop,
                   QStringLiteral("%1 %2").arg(QLocale().toString(value, 'f',
                                                                  value < 10    ? 2
                                                                  : value < 100 ? 1
                                                                                : 0),
                                               unit_));
}

}  // namespace windfall::widgets
