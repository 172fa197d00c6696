#include "model/leaf/stage_picture.h"

#include <QPainter>
#include <QPainterPath>
#include <QPolygonF>
#include <algorithm>

#include "model/leaf/field_picture.h"
#include "model/leaf/vein_curve.h"

namespace windfall::model {

namespace {

QImage labelPicture(const LabelField& field, bool borders) {
  const int width = field.size.width(), height = field.size.height();
  QImage image(field.size, QImage::Format_ARGB32);
  image.fill(Qt::transparent);
  for (int y = 0; y < height; ++y) {
    auto* row = reinterpret_cast<QRgb*>(image.scanLine(y));
    for (int x = 0; x < width; ++x) {
      const size_t i = static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x);
      const qint32 label = field.values[i];
      if (label <= 0) continue;
      const bool edge = borders && ((x + 1 < width && field.values[i + 1] != label) ||
                                    (y + 1 < height && field.values[i + static_cast<size_t>(width)] != label));
      row[x] = edge ? qRgba(20, 20, 20, 255) : regionColour(label);
    }
  }
  return image;
}

/// Lines and marks in photo pixels; thin enough for any zoom, with a dark rim so that they show on any leaf.
class Marks {
 public:
  Marks(QImage& image, int fine) : painter_(&image), unit_(std::max(image.width(), image.height()) / 700.0 / fine) {
    painter_.setRenderHint(QPainter::Antialiasing);
    painter_.scale(fine, fine);
  }
  void line(const std::vector<QPointF>& points, const QColor& colour, double width, bool closed, bool rim = true) {
    QPainterPath path;
    path.addPolygon(QPolygonF(QList<QPointF>(points.begin(), points.end())));
    if (closed) path.closeSubpath();
    painter_.setBrush(Qt::NoBrush);
    if (rim) {
      painter_.setPen(QPen(QColor(0, 0, 0, 150), (width + 1.4) * unit_, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
      painter_.drawPath(path);
    }
    painter_.setPen(QPen(colour, width * unit_, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    painter_.drawPath(path);
  }
  void dot(QPointF place, const QColor& colour, double radius) {
    painter_.setPen(QPen(QColor(0, 0, 0, 180), 1.2 * unit_));
    painter_.setBrush(colour);
    painter_.drawEllipse(place, radius * unit_, radius * unit_);
  }

 private:
  QPainter painter_;
  double unit_;
};

const QColor kOutline(255, 214, 64), kRoot(64, 200, 255), kTip(255, 96, 160), kMain(255, 92, 64),
    kLateral(255, 226, 120), kFine(214, 246, 196);

}  // namespace

QImage stagePicture(const LeafStages& stages, Stage stage) { return fineStagePicture(stages, stage, 1); }

QImage fineStagePicture(const LeafStages& stages, Stage stage, int fine) {
  if (stage == Stage::Photo || stage > stages.reached) return {};
  if (stage != Stage::Contour && stage != Stage::Veins && stage != Stage::Regions) fine = 1;
  QImage image(stages.photo.size() * fine, QImage::Format_ARGB32);
  image.fill(Qt::transparent);
  const auto sized = [&](const QImage& working) {
    QImage whole(stages.photo.size() * fine, QImage::Format_ARGB32);
    whole.fill(Qt::transparent);
    QPainter(&whole).drawImage(
        stages.frame.topLeft() * fine,
        working.scaled(stages.frame.size() * fine, Qt::IgnoreAspectRatio, Qt::SmoothTransformation));
    return whole;
  };
  FieldScale scale;
  switch (stage) {
    case Stage::Mask:
      // The ground is veiled, the leaf is left as it is: what will be lost is what is dimmed.
      for (int y = 0; y < image.height(); ++y) {
        auto* row = reinterpret_cast<QRgb*>(image.scanLine(y));
        const uchar* leaf = stages.mask.constScanLine(y);
        for (int x = 0; x < image.width(); ++x) row[x] = leaf[x] > 127 ? qRgba(0, 0, 0, 0) : qRgba(196, 36, 76, 190);
      }
      break;
    case Stage::Contour: {
      Marks marks(image, fine);
      marks.line(stages.contour, kOutline, 1.6, true);
      for (const QPointF& point : stages.contour) marks.dot(point, kOutline, 2.4);
      marks.dot(stages.root, kRoot, 6);
      marks.dot(stages.tip, kTip, 6);
      break;
    }
    case Stage::Veins: {
      Marks marks(image, fine);
      for (const int order : {4, 3, 2, 1}) {
        static constexpr double kWidths[] = {3, 1.7, 1.0, 0.7};
        for (const Vein& vein : stages.veins) {
          if (std::clamp(vein.order, 1, 4) != order) continue;
          marks.line(throughPoints(vein.points),
                     order == 1   ? kMain
                     : order == 2 ? kLateral
                                  : kFine,
                     kWidths[order - 1], false, order <= 2);
        }
      }
      marks.dot(stages.root, kRoot, 6);
      break;
    }
    case Stage::Distance:
      image = fieldPicture(stages, LeafField::Structural, scale);
      break;
    case Stage::Regions: {
      image = sized(labelPicture(stages.grown.regions, true));
      Marks marks(image, fine);
      for (const QPointF& marker : stages.markers) marks.dot(marker, Qt::white, 3);
      break;
    }
    case Stage::Superpixels:
      image = sized(labelPicture(stages.grown.superpixels, false));
      break;
    case Stage::Photo:
    case Stage::Variants:
    case Stage::Maps:
    case Stage::Atlas:
      break;
  }
  return image;
}

}  // namespace windfall::model
