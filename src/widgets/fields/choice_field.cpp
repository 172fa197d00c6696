#include "widgets/fields/choice_field.h"

#include <QAbstractButton>
#include <QColorDialog>
#include <QHBoxLayout>
#include <QLineEdit>
#include <QPainter>

#include "widgets/look/look.h"

namespace windfall::widgets {

CheckField::CheckField(const QString& label, bool defaultValue, QWidget* parent)
    : Field(label, parent), box_(new CheckBox({}, this)), default_(defaultValue) {
  row()->addWidget(box_);
  row()->addStretch(1);
  closeRow();
  setValue(defaultValue);
  connect(box_, &QAbstractButton::clicked, this, [this] {
    // A click on a mixed box makes all of them true.
    setValue(isMixed() || box_->checkState() == Qt::Checked);
    emit edited(value(), true);
    finishGesture();
  });
}

void CheckField::setValue(bool value) {
  clearMixed();
  box_->setTristate(false);
  box_->setChecked(value);
  showState(value == default_);
}

void CheckField::setMixed() {
  Field::setMixed();
  box_->setTristate(true);
  box_->setCheckState(Qt::PartiallyChecked);
}

void CheckField::reset() {
  setValue(default_);
  emit edited(default_, true);
  finishGesture();
}

ChoiceField::ChoiceField(const QString& label, const QStringList& choices, int defaultValue, QWidget* parent)
    : Field(label, parent), box_(new ComboBox(this)), default_(defaultValue) {
  box_->addItems(choices);
  box_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  row()->addWidget(box_, 1);
  closeRow();
  setValue(defaultValue);
  connect(box_, &QComboBox::activated, this, [this](int index) {
    setValue(index);
    emit edited(index, true);
    finishGesture();
  });
}

void ChoiceField::setValue(int index) {
  clearMixed();
  box_->setCurrentIndex(index);
  showState(index == default_);
}

void ChoiceField::setMixed() {
  Field::setMixed();
  box_->setPlaceholderText(QStringLiteral("—"));
  box_->setCurrentIndex(-1);
}

void ChoiceField::reset() {
  setValue(default_);
  emit edited(default_, true);
  finishGesture();
}

namespace {

class Swatch : public QAbstractButton {
 public:
  Swatch(const ColorField* field, QWidget* parent) : QAbstractButton(parent), field_(field) {
    setFixedHeight(20);
    setCursor(Qt::PointingHandCursor);
  }

 protected:
  void paintEvent(QPaintEvent*) override {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(colors(palette()).border);
    painter.setBrush(field_->value());
    painter.drawRoundedRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5), 4, 4);
  }

 private:
  const ColorField* field_;
};

}  // namespace

ColorField::ColorField(const QString& label, const QColor& defaultValue, QWidget* parent)
    : Field(label, parent), default_(defaultValue) {
  auto* swatch = new Swatch(this, this);
  swatch_ = swatch;
  row()->addWidget(swatch, 1);
  closeRow();
  setValue(defaultValue);
  connect(swatch, &QAbstractButton::clicked, this, &ColorField::choose);
}

void ColorField::setValue(const QColor& color) {
  clearMixed();
  value_ = color;
  swatch_->update();
  showState(color == default_);
}

void ColorField::choose() {
  auto* dialog = new QColorDialog(value_, this);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  const QColor before = value_;
  connect(dialog, &QColorDialog::currentColorChanged, this, [this](const QColor& color) {
    setValue(color);
    emit edited(color, false);
  });
  connect(dialog, &QDialog::finished, this, [this, before](int result) {
    if (result != QDialog::Accepted) setValue(before);
    emit edited(value_, true);
    finishGesture();
  });
  dialog->open();
}

void ColorField::reset() {
  setValue(default_);
  emit edited(default_, true);
  finishGesture();
}

TextField::TextField(const QString& label, QWidget* parent) : Field(label, parent), edit_(new QLineEdit(this)) {
  row()->addWidget(edit_, 1);
  closeRow();
  connect(edit_, &QLineEdit::editingFinished, this, [this] {
    if (!edit_->isModified()) return;
    edit_->setModified(false);
    emit edited(edit_->text(), true);
    finishGesture();
  });
}

QString TextField::value() const { return edit_->text(); }

void TextField::setValue(const QString& text) {
  if (edit_->text() != text) edit_->setText(text);
}

InfoField::InfoField(const QString& label, QWidget* parent) : Field(label, parent), text_(new ElidedLabel({}, this)) {
  row()->addWidget(text_, 1);
  closeRow();
}

void InfoField::setValue(const QString& text) {
  text_->setToolTip({});
  text_->setText(text);
}

}  // namespace windfall::widgets
