// Leaves for tests: painted from code, so that nothing depends on the shared data.
#pragma once

#include <QBuffer>
#include <QImage>
#include <QPainter>

#include "model/leaf/leaf.h"
#include "model/sample/leaf_painter.h"

namespace windfall::test {

inline QByteArray encoded(const QImage& image, const char* format) {
  QByteArray bytes;
  QBuffer buffer(&bytes);
  buffer.open(QIODevice::WriteOnly);
  image.save(&buffer, format, 95);
  return bytes;
}

/// A leaf asset whose photo is painted; `size` is the long side of photo and textures.
inline model::Leaf paintedLeaf(const model::PaintedLeaf& look, quint64 seed, int size) {
  model::Leaf leaf;
  leaf.photo = {QStringLiteral("painted.png"), encoded(model::paintLeafPhoto(look, seed, size).photo, "PNG")};
  leaf.parameters.synthesis.size = size;
  leaf.parameters.synthesis.superpixels = 400;
  return leaf;
}

/// White pixels in both over white pixels in either; Grayscale8 of equal size.
inline double overlap(const QImage& a, const QImage& b) {
  qint64 both = 0, either = 0;
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      const bool inA = a.constScanLine(y)[x] > 127, inB = b.constScanLine(y)[x] > 127;
      both += inA && inB;
      either += inA || inB;
    }
  }
  return either > 0 ? static_cast<double>(both) / static_cast<double>(either) : 1;
}

/// An ellipse, white on black.
inline QImage ellipseMask(QSize size, const QRectF& box) {
  QImage mask(size, QImage::Format_Grayscale8);
  mask.fill(0);
  QPainter painter(&mask);
  painter.setBrush(Qt::white);
  painter.setPen(Qt::NoPen);
  painter.drawEllipse(box);
  return mask;
}

}  // namespace windfall::test
