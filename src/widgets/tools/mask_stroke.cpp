#include "widgets/tools/mask_stroke.h"

#include <QPainter>

namespace windfall::widgets {

bool MaskStroke::begin(ToolHost& host) {
  mask_ = host.currentMask();
  dirty_ = {};
  return isActive();
}

void MaskStroke::line(QPointF from, QPointF to, double width, int value, ToolHost& host) {
  if (!isActive()) return;
  {
    QPainter painter(&mask_);
    painter.setRenderHint(QPainter::Antialiasing);
    const QColor color(value, value, value);
    if (from == to) {
      painter.setPen(Qt::NoPen);
      painter.setBrush(color);
      painter.drawEllipse(to, width / 2, width / 2);
    } else {
      painter.setPen(QPen(color, width, Qt::SolidLine, Qt::RoundCap));
      painter.drawLine(from, to);
    }
  }
  const double margin = width / 2 + 2;
  touched(QRectF(from, to).normalized().adjusted(-margin, -margin, margin, margin), host);
}

void MaskStroke::fill(const QPainterPath& area, int value, ToolHost& host) {
  if (!isActive()) return;
  {
    QPainter painter(&mask_);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.fillPath(area, QColor(value, value, value));
  }
  touched(area.boundingRect().adjusted(-2, -2, 2, 2), host);
}

void MaskStroke::touched(const QRectF& area, ToolHost& host) {
  const QRect part = area.toAlignedRect() & mask_.rect();
  dirty_ |= part;
  host.previewMask(mask_, part);
}

void MaskStroke::finish(const QString& text, ToolHost& host) {
  if (!isActive()) return;
  const QImage mask = std::exchange(mask_, {});
  if (!dirty_.isEmpty()) host.document().paintMask(host.leaf(), mask, dirty_, text);
  host.previewMask({}, dirty_);
}

void MaskStroke::cancel(ToolHost& host) {
  if (!isActive()) return;
  mask_ = {};
  host.previewMask({}, dirty_);
}

void drawBrush(QPainter& painter, QPointF pointer, double size, double pixel) {
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(QColor(0, 0, 0, 160), 3 * pixel));
  painter.drawEllipse(pointer, size / 2, size / 2);
  painter.setPen(QPen(Qt::white, 1.25 * pixel));
  painter.drawEllipse(pointer, size / 2, size / 2);
}

}  // namespace windfall::widgets
