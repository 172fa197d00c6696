// A photo for tests, drawn: an ovate leaf with veins on pale paper.
#pragma once

#include <QBuffer>
#include <QImage>
#include <QPainter>
#include <QPainterPath>

#include "model/leaf/leaf.h"

namespace windfall::test {

inline QImage paintedLeafPhoto(QSize size = {480, 640}) {
  QImage image(size, QImage::Format_RGB32);
  image.fill(QColor(232, 230, 222));
  QPainter painter(&image);
  painter.setRenderHint(QPainter::Antialiasing);
  const double w = size.width(), h = size.height();
  QPainterPath blade(QPointF(w * 0.5, h * 0.85));
  blade.cubicTo(w * 0.05, h * 0.75, w * 0.12, h * 0.25, w * 0.5, h * 0.06);
  blade.cubicTo(w * 0.88, h * 0.25, w * 0.95, h * 0.75, w * 0.5, h * 0.85);
  painter.setPen(Qt::NoPen);
  painter.setBrush(QColor(92, 140, 52));
  painter.drawPath(blade);
  painter.setClipPath(blade);
  painter.setPen(QPen(QColor(150, 186, 104), w * 0.012));
  painter.drawLine(QPointF(w * 0.5, h * 0.85), QPointF(w * 0.5, h * 0.08));
  painter.setPen(QPen(QColor(132, 172, 88), w * 0.006));
  for (int i = 1; i < 8; ++i) {
    const double y = h * (0.85 - 0.09 * i);
    painter.drawLine(QPointF(w * 0.5, y), QPointF(w * 0.86, y - h * 0.12));
    painter.drawLine(QPointF(w * 0.5, y), QPointF(w * 0.14, y - h * 0.12));
  }
  painter.setClipping(false);
  painter.setPen(QPen(QColor(104, 128, 62), w * 0.018, Qt::SolidLine, Qt::RoundCap));
  painter.drawLine(QPointF(w * 0.5, h * 0.85), QPointF(w * 0.53, h * 0.97));
  return image;
}

inline model::Leaf paintedLeaf(const QString& name = QStringLiteral("painted")) {
  model::Leaf leaf;
  leaf.name = name;
  leaf.photo.name = name + QStringLiteral(".png");
  QBuffer buffer(&leaf.photo.bytes);
  buffer.open(QIODevice::WriteOnly);
  paintedLeafPhoto().save(&buffer, "PNG");
  leaf.parameters.synthesis.size = 256;
  leaf.parameters.synthesis.superpixels = 256;
  return leaf;
}

}  // namespace windfall::test
