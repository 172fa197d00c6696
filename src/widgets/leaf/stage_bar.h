// Photo › Mask › Contour › …: where the work is, and what is shown.
#pragma once

#include <QAbstractButton>
#include <QWidget>
#include <vector>

#include "model/leaf/field_picture.h"
#include "widgets/leaf/leaf_pictures.h"

namespace windfall::widgets {

class ComboBox;
class Slider;

/// A stage's name with its dot: filled accent for automatic, a ring for edited by hand, orange for out of date.
class StageChip : public QAbstractButton {
  Q_OBJECT
 public:
  StageChip(const QString& title, QWidget* parent);
  void setState(StageState state);
  StageState state() const { return state_; }
  QSize sizeHint() const override;

 protected:
  void paintEvent(QPaintEvent*) override;

 private:
  StageState state_ = StageState::Unknown;
};

class StageBar : public QWidget {
  Q_OBJECT
 public:
  explicit StageBar(QWidget* parent = nullptr);
  void setStage(model::Stage stage);
  void setState(model::Stage stage, StageState state);
  StageChip* chip(model::Stage stage) const { return chips_[std::size_t(stage)]; }
  double opacity() const;
  void setOpacity(double opacity);
  static QString title(model::Stage stage);
  /// Which field Stage::Distance shows; the choice is offered there alone.
  model::LeafField field() const;
  void setField(model::LeafField field);
  ComboBox* fieldBox() const { return field_; }

 signals:
  void chosen(windfall::model::Stage stage);
  void opacityChanged(double opacity);
  void fieldChanged();

 protected:
  void paintEvent(QPaintEvent*) override;

 private:
  std::vector<StageChip*> chips_;
  Slider* opacity_;
  ComboBox* field_;
};

}  // namespace windfall::widgets
