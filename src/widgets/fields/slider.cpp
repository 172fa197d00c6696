#include "widgets/fields/slider.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QWheelEvent>

#include "widgets/look/look.h"

namespace windfall::widgets {

namespace {
constexpr double kHandle = 5;  // radius, px
}

Slider::Slider(QWidget* parent) : QWidget(parent) {
  setFocusPolicy(Qt::ClickFocus);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  setCursor(Qt::PointingHandCursor);
}

void Slider::setPosition(double position) {
  position_ = std::clamp(position, 0.0, 1.0);
  mixed_ = false;
  update();
}

void Slider::setMixed(bool mixed) {
  mixed_ = mixed;
  update();
}

void Slider::moveTo(double position) {
  setPosition(position);
  emit dragged(position_);
}

void Slider::paintEvent(QPaintEvent*) {
  const Colors& c = colors(palette());
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(Qt::NoPen);
  if (!isEnabled()) painter.setOpacity(0.4);
  const double middle = height() / 2.0;
  const double left = kHandle, right = width() - kHandle;
  painter.setBrush(c.border);
  painter.drawRoundedRect(QRectF(left - 2, middle - 2, right - left + 4, 4), 2, 2);
  if (mixed_) return;
  const double x = left + position_ * (right - left);
  painter.setBrush(c.accent);
  painter.drawRoundedRect(QRectF(left - 2, middle - 2, x - left + 4, 4), 2, 2);
  const double radius = dragging_ || underMouse() || hasFocus() ? kHandle : kHandle - 1;
  painter.drawEllipse(QPointF(x, middle), radius, radius);
}

void Slider::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  dragging_ = true;
  lastX_ = event->position().x();
  if (!(event->modifiers() & Qt::ShiftModifier)) moveTo((lastX_ - kHandle) / std::max(1.0, width() - 2 * kHandle));
}

void Slider::mouseMoveEvent(QMouseEvent* event) {
  if (!dragging_) return;
  const double x = event->position().x();
  const double span = std::max(1.0, width() - 2 * kHandle);
  if (event->modifiers() & Qt::ShiftModifier) {
    moveTo(position_ + 0.1 * (x - lastX_) / span);
  } else {
    moveTo((x - kHandle) / span);
  }
  lastX_ = x;
}

void Slider::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton || !dragging_) return;
  dragging_ = false;
  update();
  emit released();
}

void Slider::keyPressEvent(QKeyEvent* event) {
  double by = 0;
  if (event->key() == Qt::Key_Left || event->key() == Qt::Key_Down) by = -step_;
  if (event->key() == Qt::Key_Right || event->key() == Qt::Key_Up) by = step_;
  if (by == 0) return QWidget::keyPressEvent(event);
  moveTo(position_ + by);
  emit released();
}

void Slider::wheelEvent(QWheelEvent* event) {
  // A wheel that scrolls the inspector must not change what passes under the pointer.
  if (!hasFocus()) return event->ignore();
  moveTo(position_ + step_ * event->angleDelta().y() / 120.0);
  emit released();
  event->accept();
}

}  // namespace windfall::widgets
