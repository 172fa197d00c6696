#include "widgets/fields/dial_field.h"

#include <QHBoxLayout>
#include <QMouseEvent>
#include <QPainter>
#include <cmath>
#include <numbers>

#include "widgets/fields/number_field.h"
#include "widgets/look/look.h"

namespace windfall::widgets {

Dial::Dial(QWidget* parent) : QWidget(parent) {
  setFixedSize(Dial::sizeHint());
  setCursor(Qt::PointingHandCursor);
}

void Dial::setAngle(double degrees) {
  angle_ = degrees;
  mixed_ = false;
  update();
}

void Dial::setMixed(bool mixed) {
  mixed_ = mixed;
  update();
}

void Dial::setCompass(bool compass) {
  compass_ = compass;
  update();
}

void Dial::paintEvent(QPaintEvent*) {
  const Colors& c = colors(palette());
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  if (!isEnabled()) painter.setOpacity(0.4);
  const QPointF center(width() / 2.0, height() / 2.0);
  const double radius = width() / 2.0 - 2;
  painter.setPen(QPen(underMouse() ? c.muted : c.border, 1.5));
  painter.setBrush(c.field);
  painter.drawEllipse(center, radius, radius);
  painter.setPen(QPen(c.muted, 1));
  for (int i = 0; i < 12; ++i) {
    if (compass_ && i % 3 == 0) continue;
    const double a = i * std::numbers::pi / 6;
    const QPointF direction(std::sin(a), -std::cos(a));
    painter.drawLine(center + direction * (radius - 4), center + direction * (radius - 2));
  }
  if (compass_) {
    QFont font = this->font();
    font.setPixelSize(9);
    painter.setFont(font);
    const QString letters[] = {tr("N", "compass"), tr("E", "compass"), tr("S", "compass"), tr("W", "compass")};
    for (int i = 0; i < 4; ++i) {
      const double a = i * std::numbers::pi / 2;
      const QPointF at = center + QPointF(std::sin(a), -std::cos(a)) * (radius - 7);
      painter.drawText(QRectF(at.x() - 8, at.y() - 8, 16, 16), Qt::AlignCenter, letters[i]);
    }
  }
  if (mixed_) return;
  const double a = angle_ * std::numbers::pi / 180;
  const QPointF direction(std::sin(a), -std::cos(a)), side(-direction.y(), direction.x());
  const double reach = compass_ ? radius - 13 : radius - 7;
  painter.setPen(QPen(c.accent, 2, Qt::SolidLine, Qt::RoundCap));
  painter.drawLine(center - direction * reach * 0.6, center + direction * (reach - 4));
  painter.setPen(Qt::NoPen);
  painter.setBrush(c.accent);
  const QPointF tip = center + direction * reach;
  painter.drawPolygon(QPolygonF({tip, tip - direction * 7 + side * 4, tip - direction * 7 - side * 4}));
}

void Dial::turn(const QPointF& position, bool snap) {
  const QPointF d = position - QPointF(width() / 2.0, height() / 2.0);
  if (std::hypot(d.x(), d.y()) < 3) return;
  double degrees = std::atan2(d.x(), -d.y()) * 180 / std::numbers::pi;
  if (degrees < 0) degrees += 360;
  degrees = snap ? std::fmod(std::round(degrees / 15) * 15, 360.0) : std::fmod(std::round(degrees), 360.0);
  setAngle(degrees);
  emit turned(degrees);
}

void Dial::mousePressEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton) turn(event->position(), event->modifiers() & Qt::ShiftModifier);
}

void Dial::mouseMoveEvent(QMouseEvent* event) {
  if (event->buttons() & Qt::LeftButton) turn(event->position(), event->modifiers() & Qt::ShiftModifier);
}

void Dial::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton) emit released();
}

DialField::DialField(const QString& label, double defaultValue, bool compass, QWidget* parent)
    : Field(label, parent), dial_(new Dial(this)), box_(new NumberBox(this)), default_(defaultValue) {
  dial_->setCompass(compass);
  box_->setDecimals(0);
  box_->setRange(0, 360);
  box_->setWrapping(true);
  box_->setSuffix(QStringLiteral("°"));
  box_->setFixedWidth(kNumberWidth);
  row()->addWidget(dial_);
  setMinimumHeight(dial_->height());
  row()->addStretch(1);
  row()->addWidget(box_);
  closeRow();
  setValue(defaultValue);
  connect(dial_, &Dial::turned, this, [this](double degrees) {
    setValue(degrees);
    emit edited(degrees, false);
  });
  connect(dial_, &Dial::released, this, [this] {
    emit edited(value_, true);
    finishGesture();
  });
  connect(box_, &QDoubleSpinBox::valueChanged, this, [this](double degrees) {
    setValue(degrees);
    emit edited(degrees, true);
    finishGesture();
  });
}

void DialField::setValue(double degrees) {
  value_ = degrees;
  clearMixed();
  const QSignalBlocker blocker(box_);
  box_->setMixed(false);
  box_->setValue(degrees);
  dial_->setAngle(degrees);
  showState(std::round(degrees) == std::round(default_));
}

void DialField::setMixed() {
  Field::setMixed();
  box_->setMixed(true);
  dial_->setMixed(true);
}

void DialField::reset() {
  setValue(default_);
  emit edited(default_, true);
  finishGesture();
}

}  // namespace windfall::widgets
