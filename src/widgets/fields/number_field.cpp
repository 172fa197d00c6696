#include "widgets/fields/number_field.h"

#include <QHBoxLayout>
#include <QLineEdit>
#include <QToolButton>
#include <cmath>

#include "widgets/fields/slider.h"
#include "widgets/look/icon.h"

namespace windfall::widgets {

NumberField::NumberField(const QString& label, const NumberSpec& spec, QWidget* parent)
    : Field(label, parent), box_(new NumberBox(this)), slider_(new Slider(this)) {
  box_->setFixedWidth(kNumberWidth);
  row()->addWidget(slider_, 1);
  row()->addWidget(box_);
  closeRow();
  setSpec(spec);
  setValue(spec.defaultValue);
  connect(slider_, &Slider::dragged, this, [this](double position) {
    const double value = rounded(fromPosition(position));
    if (value == value_ && !isMixed()) return;
    value_ = value;
    clearMixed();
    showValue();
    emit edited(value_, false);
  });
  connect(slider_, &Slider::released, this, [this] {
    emit edited(value_, true);
    finishGesture();
  });
  // editingFinished and not valueChanged: in a mixed row the same number is an edit too.
  connect(box_, &QDoubleSpinBox::valueChanged, this, [this](double value) {
    value_ = value;
    clearMixed();
    showValue();
    emit edited(value_, true);
    finishGesture();
  });
  connect(box_, &QAbstractSpinBox::editingFinished, this, [this] {
    if (!isMixed() || box_->isMixed()) return;
    clearMixed();
    showValue();
    emit edited(value_, true);
    finishGesture();
  });
}

void NumberField::setSpec(const NumberSpec& spec) {
  spec_ = spec;
  if (spec_.step == 0) spec_.step = spec_.decimals == 0 ? 1 : (spec_.maximum - spec_.minimum) / 100;
  if (spec_.hardMinimum == spec_.hardMaximum) {
    spec_.hardMinimum = spec_.minimum;
    spec_.hardMaximum = spec_.maximum;
  }
  const QSignalBlocker blocker(box_);
  box_->setDecimals(spec_.decimals);
  box_->setRange(spec_.hardMinimum, spec_.hardMaximum);
  box_->setSingleStep(spec_.step);
  const bool tight = spec_.unit == QStringLiteral("°") || spec_.unit == QStringLiteral("×");
  box_->setSuffix(spec_.unit.isEmpty() ? QString() : tight ? spec_.unit : QStringLiteral(" ") + spec_.unit);
  slider_->setStep(spec_.logarithmic ? 0.02 : spec_.step / (spec_.maximum - spec_.minimum));
}

void NumberField::setValue(double value) {
  value_ = value;
  clearMixed();
  showValue();
}

void NumberField::setMixed() {
  Field::setMixed();
  slider_->setMixed(true);
  box_->setMixed(true);
}

void NumberField::reset() {
  value_ = spec_.defaultValue;
  clearMixed();
  showValue();
  emit edited(value_, true);
  finishGesture();
}

void NumberField::showValue() {
  const QSignalBlocker blocker(box_);
  box_->setMixed(false);
  box_->setValue(value_);
  slider_->setPosition(toPosition(value_));
  showState(rounded(value_) == rounded(spec_.defaultValue));
}

double NumberField::rounded(double value) const {
  const double scale = std::pow(10.0, spec_.decimals);
  return std::round(value * scale) / scale;
}

double NumberField::fromPosition(double position) const {
  if (spec_.logarithmic) return spec_.minimum * std::pow(spec_.maximum / spec_.minimum, position);
  return spec_.minimum + position * (spec_.maximum - spec_.minimum);
}

double NumberField::toPosition(double value) const {
  if (spec_.logarithmic) {
    return std::log(std::max(value, spec_.minimum) / spec_.minimum) / std::log(spec_.maximum / spec_.minimum);
  }
  return (value - spec_.minimum) / (spec_.maximum - spec_.minimum);
}

SeedField::SeedField(const QString& label, QWidget* parent)
    : Field(label, parent), box_(new NumberBox(this)), dice_(new QToolButton(this)) {
  box_->setDecimals(0);
  box_->setRange(0, 9007199254740991.0);
  dice_->setIcon(icon(QStringLiteral("dice")));
  dice_->setIconSize({16, 16});
  dice_->setFixedSize(24, 24);
  dice_->setToolTip(tr("Another seed"));
  row()->addStretch(1);
  row()->addWidget(dice_);
  box_->setFixedWidth(kNumberWidth);
  row()->addWidget(box_);
  closeRow();
  setValue(1);
  connect(dice_, &QToolButton::clicked, this, [this] { choose((value_ * 48271 + 11) % 99991); });
  connect(box_, &QDoubleSpinBox::valueChanged, this, [this](double value) { choose(quint64(value)); });
}

void SeedField::setValue(quint64 seed) {
  value_ = seed;
  clearMixed();
  const QSignalBlocker blocker(box_);
  box_->setMixed(false);
  box_->setValue(double(seed));
  showState(seed == 1);
}

void SeedField::setMixed() {
  Field::setMixed();
  box_->setMixed(true);
}

void SeedField::reset() { choose(1); }

void SeedField::choose(quint64 seed) {
  setValue(seed);
  emit edited(value_, true);
  finishGesture();
}

}  // namespace windfall::widgets
