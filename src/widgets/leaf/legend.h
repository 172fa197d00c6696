// What the colours over a photo mean: a bar with values, or named swatches.
#pragma once

#include <QColor>
#include <QPainter>
#include <QString>
#include <utility>
#include <vector>

#include "model/leaf/field_picture.h"

namespace windfall::widgets {

struct Colors;

/// Empty title: no legend.
struct Legend {
  QString title;
  std::vector<QRgb> ramp;                          ///< left to right
  std::vector<std::pair<double, QString>> ticks;   ///< place on the bar, 0..1, and its value
  std::vector<std::pair<QRgb, QString>> swatches;  ///< instead of a bar
  bool isEmpty() const { return title.isEmpty(); }
};

/// The legend of a field; `pixelsPerMetre` of its texture, 0: unknown.
Legend legendOf(model::LeafField field, const model::FieldScale& scale, double pixelsPerMetre);
/// The field's name, translated.
QString fieldTitle(model::LeafField field);

/// Draws it in the lower left corner of `area`.
void drawLegend(QPainter& painter, const Legend& legend, const QRect& area, const Colors& colors);

}  // namespace windfall::widgets
