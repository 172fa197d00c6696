#include <QPainter>
#include <QPainterPath>
#include <QPolygonF>
#include <algorithm>
#include <array>
#include <cmath>

#include "kernels/random.h"
#include "model/leaf/stages.h"

namespace windfall::model {

namespace {

/// Anchors of a colour map that gets evenly lighter: dark violet, blue, green, yellow.
QRgb mapColour(float value) {
  static constexpr std::array<std::array<float, 3>, 6> kAnchors{
      {{68, 1, 84}, {65, 68, 135}, {42, 120, 142}, {34, 168, 132}, {122, 209, 81}, {253, 231, 37}}};
  const float place = std::clamp(value, 0.f, 1.f) * 5;
  const auto low = static_cast<size_t>(std::min(4.f, std::floor(place)));
  const float t = place - static_cast<float>(low);
  const auto channel = [&](size_t c) {
    return static_cast<int>(std::lround(kAnchors[low][c] * (1 - t) + kAnchors[low + 1][c] * t));
  };
  return qRgba(channel(0), channel(1), channel(2), 255);
}

/// A colour of its own for a label; neighbours in number are far apart in hue.
QRgb labelColour(qint32 label) {
  const auto seed = static_cast<std::uint32_t>(label);
  const float hue = std::fmod(0.61803399f * static_cast<float>(label), 1.f);
  return QColor::fromHsvF(hue, 0.45f + 0.3f * uniform(7, seed, 1), 0.70f + 0.28f * uniform(7, seed, 2)).rgba();
}

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
      row[x] = edge ? qRgba(20, 20, 20, 255) : labelColour(label);
    }
  }
  return image;
}

QImage distancePicture(const ScalarField& field, const QImage& alpha) {
  QImage image(field.size, QImage::Format_ARGB32);
  image.fill(Qt::transparent);
  for (int y = 0; y < field.size.height(); ++y) {
    auto* row = reinterpret_cast<QRgb*>(image.scanLine(y));
    const uchar* leaf = alpha.constScanLine(y);
    for (int x = 0; x < field.size.width(); ++x) {
      if (leaf[x] < 128) continue;
      row[x] = mapColour(
          field.values[static_cast<size_t>(y) * static_cast<size_t>(field.size.width()) + static_cast<size_t>(x)]);
    }
  }
  return image;
}

/// Lines and marks in photo pixels; thin enough for any zoom, with a dark rim so that they show on any leaf.
class Marks {
 public:
  explicit Marks(QImage& image) : painter_(&image), unit_(std::max(image.width(), image.height()) / 700.0) {
    painter_.setRenderHint(QPainter::Antialiasing);
  }
  void line(const std::vector<QPointF>& points, const QColor& colour, double width, bool closed) {
    QPainterPath path;
    path.addPolygon(QPolygonF(QList<QPointF>(points.begin(), points.end())));
    if (closed) path.closeSubpath();
    painter_.setBrush(Qt::NoBrush);
    painter_.setPen(QPen(QColor(0, 0, 0, 150), (width + 1.4) * unit_, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    painter_.drawPath(path);
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
    kLateral(255, 226, 120);

}  // namespace

QImage stagePicture(const LeafStages& stages, Stage stage) {
  if (stage == Stage::Photo || stage > stages.reached) return {};
  QImage image(stages.photo.size(), QImage::Format_ARGB32);
  image.fill(Qt::transparent);
  const auto sized = [&](const QImage& working) {
    QImage whole(stages.photo.size(), QImage::Format_ARGB32);
    whole.fill(Qt::transparent);
    QPainter(&whole).drawImage(stages.frame.topLeft(),
                               working.scaled(stages.frame.size(), Qt::IgnoreAspectRatio, Qt::SmoothTransformation));
    return whole;
  };
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
      Marks marks(image);
      marks.line(stages.contour, kOutline, 1.6, true);
      for (const QPointF& point : stages.contour) marks.dot(point, kOutline, 2.4);
      marks.dot(stages.root, kRoot, 6);
      marks.dot(stages.tip, kTip, 6);
      break;
    }
    case Stage::Veins: {
      Marks marks(image);
      for (const int order : {3, 2, 1}) {
        for (const Vein& vein : stages.veins) {
          if (std::min(vein.order, 3) == order)
            marks.line(vein.points, order == 1 ? kMain : kLateral, order == 1 ? 3 : 1.7, false);
        }
      }
      marks.dot(stages.root, kRoot, 6);
      break;
    }
    case Stage::Distance:
      image = sized(distancePicture(stages.grown.distance, stages.alpha));
      break;
    case Stage::Regions: {
      image = sized(labelPicture(stages.grown.regions, true));
      Marks marks(image);
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
