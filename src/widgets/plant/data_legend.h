// The scale of colours that show a plant's data.
#pragma once

#include <QWidget>

#include "model/plant/plant_data.h"

namespace windfall::widgets {

class DataLegend : public QWidget {
  Q_OBJECT
 public:
  explicit DataLegend(QWidget* parent = nullptr);
  void show(model::PlantData what, const model::LinkData& shown);
  QSize sizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  model::PlantData what_ = model::PlantData::None;
  model::LinkData data_;  ///< without its values
};

}  // namespace windfall::widgets
