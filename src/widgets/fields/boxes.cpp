#include <QPainter>
#include <QPainterPath>
#include <QWheelEvent>

#include "widgets/fields/choice_field.h"
#include "widgets/look/icon.h"
#include "widgets/look/look.h"

namespace windfall::widgets {

ComboBox::ComboBox(QWidget* parent) : QComboBox(parent) { setFocusPolicy(Qt::ClickFocus); }

void ComboBox::paintEvent(QPaintEvent* event) {
  QComboBox::paintEvent(event);
  QPainter painter(this);
  painter.setOpacity(isEnabled() ? 1 : 0.4);
  painter.drawPixmap(width() - 18, (height() - 12) / 2,
                     iconPixmap(QStringLiteral("chevron-down"), 12, colors(palette()).muted, devicePixelRatioF()));
}

void ComboBox::wheelEvent(QWheelEvent* event) {
  if (!hasFocus()) return event->ignore();
  QComboBox::wheelEvent(event);
}

CheckBox::CheckBox(const QString& text, QWidget* parent) : QCheckBox(text, parent) {
  setCursor(Qt::PointingHandCursor);
}

QSize CheckBox::sizeHint() const {
  return {text().isEmpty() ? 16 : 16 + 8 + fontMetrics().horizontalAdvance(text()), 20};
}

void CheckBox::paintEvent(QPaintEvent*) {
  const Colors& c = colors(palette());
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  if (!isEnabled()) painter.setOpacity(0.4);
  const int top = (height() - 16) / 2;
  const QRectF box(0.5, top + 0.5, 15, 15);
  const bool on = checkState() != Qt::Unchecked;
  painter.setPen(QPen(on ? c.accent : underMouse() || hasFocus() ? c.muted : c.border, 1));
  painter.setBrush(on ? c.accent : c.field);
  painter.drawRoundedRect(box, 3, 3);
  painter.setPen(QPen(c.onAccent, 2, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  painter.setBrush(Qt::NoBrush);
  if (checkState() == Qt::Checked) {
    QPainterPath tick(box.topLeft() + QPointF(3.5, 8));
    tick.lineTo(box.topLeft() + QPointF(6.3, 10.8));
    tick.lineTo(box.topLeft() + QPointF(11.5, 4.5));
    painter.drawPath(tick);
  } else if (checkState() == Qt::PartiallyChecked) {
    painter.drawLine(box.center() - QPointF(3.5, 0), box.center() + QPointF(3.5, 0));
  }
  if (text().isEmpty()) return;
  painter.setPen(c.text);
  painter.drawText(rect().adjusted(24, 0, 0, 0), Qt::AlignLeft | Qt::AlignVCenter, text());
}

}  // namespace windfall::widgets
