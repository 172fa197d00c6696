// Rows that are not numbers: check box, choice, colour, text, information.
#pragma once

#include <QCheckBox>
#include <QColor>
#include <QComboBox>

#include "widgets/fields/field.h"

class QLabel;
class QLineEdit;

namespace windfall::widgets {

/// A combo box in our look: a chevron that follows the palette, wheel only with the focus.
class ComboBox : public QComboBox {
  Q_OBJECT
 public:
  explicit ComboBox(QWidget* parent = nullptr);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
};

/// A box drawn in our look, partly checked when mixed.
class CheckBox : public QCheckBox {
  Q_OBJECT
 public:
  explicit CheckBox(const QString& text = {}, QWidget* parent = nullptr);
  QSize sizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;
  bool hitButton(const QPoint& position) const override { return rect().contains(position); }
};

class CheckField : public Field {
  Q_OBJECT
 public:
  CheckField(const QString& label, bool defaultValue, QWidget* parent = nullptr);
  bool value() const { return box_->checkState() == Qt::Checked; }
  void setValue(bool value);
  void setMixed() override;
  CheckBox* box() const { return box_; }

 signals:
  void edited(bool value, bool finished);

 protected:
  void reset() override;

 private:
  CheckBox* box_;
  bool default_;
};

class ChoiceField : public Field {
  Q_OBJECT
 public:
  /// `choices` are translated; the value is an index into them.
  ChoiceField(const QString& label, const QStringList& choices, int defaultValue, QWidget* parent = nullptr);
  int value() const { return box_->currentIndex(); }
  void setValue(int index);
  void setMixed() override;
  ComboBox* box() const { return box_; }

 signals:
  void edited(int index, bool finished);

 protected:
  void reset() override;

 private:
  ComboBox* box_;
  int default_;
};

class ColorField : public Field {
  Q_OBJECT
 public:
  ColorField(const QString& label, const QColor& defaultValue, QWidget* parent = nullptr);
  QColor value() const { return value_; }
  void setValue(const QColor& color);

 signals:
  void edited(const QColor& color, bool finished);

 protected:
  void reset() override;

 private:
  void choose();

  QWidget* swatch_;
  QColor value_, default_;
};

/// A line of text (names).
class TextField : public Field {
  Q_OBJECT
 public:
  explicit TextField(const QString& label, QWidget* parent = nullptr);
  QString value() const;
  void setValue(const QString& text);
  QLineEdit* edit() const { return edit_; }

 signals:
  void edited(const QString& text, bool finished);

 private:
  QLineEdit* edit_;
};

/// Something to read: "1,024 × 768 px".
class InfoField : public Field {
  Q_OBJECT
 public:
  explicit InfoField(const QString& label, QWidget* parent = nullptr);
  void setValue(const QString& text);
  QString value() const { return text_->text(); }

 private:
  ElidedLabel* text_;
};

}  // namespace windfall::widgets
