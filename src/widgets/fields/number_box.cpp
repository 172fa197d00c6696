#include <QFocusEvent>
#include <QLineEdit>
#include <QTimer>
#include <QWheelEvent>

#include "widgets/fields/number_field.h"

namespace windfall::widgets {

namespace {
const QString kDash = QStringLiteral("—");
}

NumberBox::NumberBox(QWidget* parent) : QDoubleSpinBox(parent) {
  setButtonSymbols(QAbstractSpinBox::NoButtons);
  setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  setKeyboardTracking(false);
  setFocusPolicy(Qt::ClickFocus);
  setLocale(QLocale::c());
  // What is typed replaces the dash, even by the number that stood below it.
  connect(lineEdit(), &QLineEdit::textEdited, this, [this] { mixed_ = false; });
}

void NumberBox::setMixed(bool mixed) {
  mixed_ = mixed;
  // Setting the value again makes the box ask for its text.
  const QSignalBlocker blocker(this);
  lineEdit()->setText(mixed_ ? kDash : textFromValue(value()) + suffix());
}

QString NumberBox::textFromValue(double number) const { return mixed_ ? kDash : QDoubleSpinBox::textFromValue(number); }

double NumberBox::valueFromText(const QString& text) const {
  if (text.startsWith(kDash)) return value();
  // A comma is a decimal point to half of the world.
  QString plain = text;
  return QDoubleSpinBox::valueFromText(plain.replace(QLatin1Char(','), QLatin1Char('.')));
}

QValidator::State NumberBox::validate(QString& text, int& position) const {
  if (text.startsWith(kDash)) return QValidator::Acceptable;
  text.replace(QLatin1Char(','), QLatin1Char('.'));
  return QDoubleSpinBox::validate(text, position);
}

void NumberBox::wheelEvent(QWheelEvent* event) {
  if (!hasFocus()) return event->ignore();
  QDoubleSpinBox::wheelEvent(event);
}

void NumberBox::focusInEvent(QFocusEvent* event) {
  QDoubleSpinBox::focusInEvent(event);
  // After the click that gave the focus, which would undo the selection.
  QTimer::singleShot(0, this, &QAbstractSpinBox::selectAll);
}

}  // namespace windfall::widgets
