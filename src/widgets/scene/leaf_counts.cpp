#include "widgets/scene/leaf_counts.h"

#include <QLocale>
#include <QPainter>
#include <QPainterPath>

#include "widgets/look/look.h"

namespace windfall::widgets {

LeafCounts::LeafCounts(QWidget* parent) : QWidget(parent) {
  setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Preferred);
  setToolTip(tr("Leaves on the trees, in the air, and on the ground"));
}

void LeafCounts::show(const sim::Statistics& statistics) {
  if (attached_ == statistics.attached && airborne_ == statistics.airborne && grounded_ == statistics.grounded) return;
  attached_ = statistics.attached;
  airborne_ = statistics.airborne;
  grounded_ = statistics.grounded;
  update();
}

void LeafCounts::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const Colors& look = colors(palette());
  const QLocale locale;
  struct Cell {
    QString name;
    int count;
    QColor color;
  };
  // From green through autumn to the colour of the ground.
  const Cell cells[] = {{tr("Hanging"), attached_, look.accent},
                        {tr("Flying"), airborne_, QColor(0xE0, 0x9A, 0x3E)},
                        {tr("Fallen"), grounded_, QColor(0x8C, 0x6A, 0x4F)}};
  const double all = std::max(attached_ + airborne_ + grounded_, 1);
  const QFontMetricsF metrics(font());
  const double width = (this->width() - 4.0 * kGrid) / 3;
  double left = 0;
  for (const Cell& cell : cells) {
    const QRectF name(left + 10, 0, width - 10, metrics.height());
    painter.setPen(Qt::NoPen);
    painter.setBrush(cell.color);
    painter.drawEllipse(QPointF(left + 3, name.center().y()), 3, 3);
    painter.setPen(look.muted);
    painter.drawText(name, Qt::AlignLeft | Qt::AlignVCenter,
                     metrics.elidedText(cell.name, Qt::ElideRight, name.width()));
    painter.setPen(look.text);
    painter.drawText(name.translated(0, metrics.height() + 2), Qt::AlignLeft | Qt::AlignVCenter,
                     locale.toString(cell.count));
    left += width + 2 * kGrid;
  }
  const QRectF bar(0, 2 * metrics.height() + 2 * kGrid, this->width() - 2.0 * kGrid, 6);
  QPainterPath clip;
  clip.addRoundedRect(bar, 3, 3);
  painter.setClipPath(clip);
  painter.fillRect(bar, look.field);
  left = bar.left();
  for (const Cell& cell : cells) {
    const double part = bar.width() * cell.count / all;
    painter.fillRect(QRectF(left, bar.top(), part, bar.height()), cell.color);
    left += part;
  }
}

}  // namespace windfall::widgets
