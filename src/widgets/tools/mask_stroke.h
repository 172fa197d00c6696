// A stroke on a mask: dabs on a copy, previewed while it runs, one undo step at its end.
#pragma once

#include <QImage>
#include <QPainterPath>

#include "widgets/tools/tool.h"

namespace windfall::widgets {

/// Begin, dabs, finish or cancel; nothing reaches the document before `finish`.
class MaskStroke {
 public:
  bool isActive() const { return !mask_.isNull(); }
  /// False where there is no mask yet.
  bool begin(ToolHost& host);
  /// A line with round ends, in photo pixels; `value` 255 is leaf, 0 is background.
  void line(QPointF from, QPointF to, double width, int value, ToolHost& host);
  void fill(const QPainterPath& area, int value, ToolHost& host);
  void finish(const QString& text, ToolHost& host);
  void cancel(ToolHost& host);

 private:
  void touched(const QRectF& area, ToolHost& host);

  QImage mask_;
  QRect dirty_;
};

/// The brush's size where the pointer is, dark and light, so that it shows on every photo; `pixel`: of the screen.
void drawBrush(QPainter& painter, QPointF pointer, double size, double pixel);

}  // namespace windfall::widgets
