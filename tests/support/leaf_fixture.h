// Leaves for tests: painted from code, so that nothing depends on the shared data.
#pragma once

#include <QBuffer>
#include <QImage>
#include <QPainter>
#include <cmath>
#include <numbers>

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

/// A narrow, bent blade from (100, 150) to (900, 150) with a petiole of 60 px at its left or right end.
inline QImage willowMask(double width, bool petioleLeft) {
  QImage mask(1000, 300, QImage::Format_Grayscale8);
  mask.fill(0);
  QPainter painter(&mask);
  QPolygonF outline;
  for (const int side : {-1, 1}) {
    for (int i = 0; i <= 80; ++i) {
      const double t = side < 0 ? i / 80.0 : 1 - i / 80.0, wave = std::sin(std::numbers::pi * t);
      outline << QPointF(100 + 800 * t, 150 + 25 * wave + side * 0.5 * width * std::pow(wave, 0.7));
    }
  }
  painter.setBrush(Qt::white);
  painter.setPen(Qt::NoPen);
  painter.drawPolygon(outline);
  painter.setPen(QPen(Qt::white, 5));
  painter.drawLine(petioleLeft ? QLineF(40, 150, 110, 151) : QLineF(960, 150, 890, 151));
  return mask;
}

}  // namespace windfall::test
