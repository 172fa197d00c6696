#include "widgets/fields/field.h"

#include <QHBoxLayout>
#include <QPainter>
#include <QToolButton>

#include "widgets/look/icon.h"
#include "widgets/look/look.h"

namespace windfall::widgets {

namespace {
// Two fields never share a gesture, even when they have the same label.
quint64 nextGesture() {
  static quint64 next = 0;
  return next += quint64(1) << 32;
}
}  // namespace

ElidedLabel::ElidedLabel(const QString& text, QWidget* parent) : QWidget(parent), text_(text) {}

void ElidedLabel::setText(const QString& text) {
  text_ = text;
  updateGeometry();
  update();
}

QSize ElidedLabel::sizeHint() const { return {fontMetrics().horizontalAdvance(text_), fontMetrics().height()}; }

void ElidedLabel::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  QColor color = colors(palette()).muted;
  if (!isEnabled()) color.setAlphaF(0.6f);
  painter.setPen(color);
  const QString shown = fontMetrics().elidedText(text_, Qt::ElideRight, width());
  if (shown != text_ && toolTip().isEmpty()) setToolTip(text_);
  painter.drawText(rect(), Qt::AlignLeft | Qt::AlignVCenter, shown);
}

Field::Field(const QString& label, QWidget* parent)
    : QWidget(parent),
      label_(new ElidedLabel(label, this)),
      row_(new QHBoxLayout(this)),
      reset_(new QToolButton(this)),
      gesture_(nextGesture()) {
  row_->setContentsMargins(0, 0, 0, 0);
  row_->setSpacing(kGrid);
  label_->setFixedWidth(kLabelWidth);
  row_->addWidget(label_);
  setMinimumHeight(kRowHeight);
  reset_->setIcon(icon(QStringLiteral("reset")));
  reset_->setIconSize({12, 12});
  reset_->setFixedSize(20, 20);
  reset_->setToolTip(tr("Back to the default"));
  reset_->setFocusPolicy(Qt::NoFocus);
  QSizePolicy policy = reset_->sizePolicy();
  policy.setRetainSizeWhenHidden(true);
  reset_->setSizePolicy(policy);
  reset_->hide();
  connect(reset_, &QToolButton::clicked, this, [this] { reset(); });
  setAccessibleName(label);
}

QString Field::gesture() const { return QStringLiteral("%1#%2").arg(label()).arg(gesture_); }

void Field::setMixed() {
  mixed_ = true;
  reset_->show();
}

void Field::showState(bool isDefault) { reset_->setVisible(mixed_ || !isDefault); }

void Field::closeRow() { row_->addWidget(reset_); }

}  // namespace windfall::widgets
