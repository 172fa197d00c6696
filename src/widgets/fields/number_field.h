// A number with slider, unit and reset.
#pragma once

#include <QDoubleSpinBox>

#include "widgets/fields/field.h"

namespace windfall::widgets {

class Slider;

/// Range and looks of a number. The slider spans minimum..maximum; typed numbers may pass them up to
/// hardMinimum..hardMaximum.
struct NumberSpec {
  double minimum = 0, maximum = 1;
  double defaultValue = 0;
  int decimals = 2;
  QString unit = {};                        ///< shown after the number: "m", "°", "px"
  bool logarithmic = false;                 ///< the slider's scale; minimum above 0 then
  double step = 0;                          ///< of keys and wheel; 0: a hundredth of the range, or 1 without decimals
  double hardMinimum = 0, hardMaximum = 0;  ///< equal: the same as the slider's range
};

/// Number box without arrows: right-aligned, a dash when mixed, wheel only with the focus.
class NumberBox : public QDoubleSpinBox {
  Q_OBJECT
 public:
  explicit NumberBox(QWidget* parent = nullptr);
  void setMixed(bool mixed);
  bool isMixed() const { return mixed_; }
  QString textFromValue(double value) const override;
  double valueFromText(const QString& text) const override;
  QValidator::State validate(QString& text, int& position) const override;

 protected:
  void wheelEvent(QWheelEvent* event) override;
  void focusInEvent(QFocusEvent* event) override;

 private:
  bool mixed_ = false;
};

class NumberField : public Field {
  Q_OBJECT
 public:
  NumberField(const QString& label, const NumberSpec& spec, QWidget* parent = nullptr);
  double value() const { return value_; }
  void setValue(double value);
  void setMixed() override;
  NumberBox* box() const { return box_; }
  Slider* slider() const { return slider_; }
  /// Replaces range, default and unit (a property whose sense depends on another).
  void setSpec(const NumberSpec& spec);

 signals:
  void edited(double value, bool finished);

 protected:
  void reset() override;

 private:
  double fromPosition(double position) const;
  double toPosition(double value) const;
  double rounded(double value) const;
  void showValue();

  NumberSpec spec_;
  NumberBox* box_;
  Slider* slider_;
  double value_ = 0;
};

/// A whole seed with a dice button instead of a slider. The next seed is drawn from the last: the same clicks, the same
/// leaves.
class SeedField : public Field {
  Q_OBJECT
 public:
  explicit SeedField(const QString& label, QWidget* parent = nullptr);
  quint64 value() const { return value_; }
  void setValue(quint64 seed);
  void setMixed() override;
  NumberBox* box() const { return box_; }
  QToolButton* dice() const { return dice_; }

 signals:
  void edited(quint64 value, bool finished);

 protected:
  void reset() override;

 private:
  void choose(quint64 seed);

  NumberBox* box_;
  QToolButton* dice_;
  quint64 value_ = 1;
};

}  // namespace windfall::widgets
