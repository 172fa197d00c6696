#include "model/sample/leaf_painter.h"

#include <QPainter>
#include <QPainterPath>
#include <QPolygonF>
#include <QTransform>
#include <algorithm>
#include <cmath>
#include <functional>
#include <opencv2/imgproc.hpp>

#include "kernels/random.h"

namespace windfall::model {

namespace {

using Colour = cv::Vec3f;  // R, G, B, 0..1

Colour mix(const Colour& a, const Colour& b, float t) { return a * (1 - t) + b * t; }

float smoothstep(float low, float high, float x) {
  const float t = std::clamp((x - low) / (high - low), 0.f, 1.f);
  return t * t * (3 - 2 * t);
}

/// Noise of one scale: random values a cell, blown up smoothly; -1..1.
cv::Mat1f noise(cv::Size size, double cell, quint64 seed, std::uint32_t stream) {
  const cv::Size grid(std::max(2, static_cast<int>(std::ceil(size.width / cell)) + 2),
                      std::max(2, static_cast<int>(std::ceil(size.height / cell)) + 2));
  cv::Mat1f values(grid);
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      values(y, x) = 2 * uniform(seed, stream, static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)) - 1;
    }
  }
  cv::Mat1f field;
  cv::resize(values, field, size, 0, 0, cv::INTER_CUBIC);
  return field;
}

cv::Mat1f cover(const QSize& size, const std::function<void(QPainter&)>& draw) {
  QImage image(size, QImage::Format_Grayscale8);
  image.fill(0);
  QPainter painter(&image);
  painter.setRenderHint(QPainter::Antialiasing);
  draw(painter);
  painter.end();
  cv::Mat1f field;
  cv::Mat(image.height(), image.width(), CV_8U, image.bits(), static_cast<size_t>(image.bytesPerLine()))
      .convertTo(field, CV_32F, 1 / 255.0);
  return field;
}

/// Draws a polyline that thins from `start` to `end` px.
void strokeTapered(QPainter& painter, const QPolygonF& line, double start, double end) {
  for (qsizetype i = 1; i < line.size(); ++i) {
    const double t = static_cast<double>(i) / static_cast<double>(line.size());
    painter.setPen(QPen(Qt::white, start + (end - start) * t, Qt::SolidLine, Qt::RoundCap));
    painter.drawLine(line[i - 1], line[i]);
  }
}

QPolygonF mapped(const QTransform& transform, const std::vector<QPointF>& points) {
  return transform.map(QPolygonF(QList<QPointF>(points.begin(), points.end())));
}

/// Leaf space to pixels: fitted with a margin, y up becomes y down.
QTransform fit(const LeafOutline& outline, QSize size, double turn) {
  QPolygonF all(QList<QPointF>(outline.blade.begin(), outline.blade.end()));
  for (const QPointF& point : outline.petiole) all << point;
  QTransform upright;
  upright.rotate(turn);
  upright.scale(1, -1);
  const QRectF box = upright.map(all).boundingRect();
  const double scale = 0.84 * std::min(size.width() / box.width(), size.height() / box.height());
  QTransform toPixels;
  toPixels.translate(size.width() / 2.0, size.height() / 2.0);
  toPixels.scale(scale, scale);
  toPixels.translate(-box.center().x(), -box.center().y());
  return upright * toPixels;
}

/// Blade, veins and their distances, in pixels.
struct Fields {
  cv::Mat1f blade, stalk, veins, fine;
  cv::Mat1f toVein;    ///< px
  cv::Mat1f toMargin;  ///< px
};

/// Areoles: the borders between the cells of scattered points, the network of the finest veins.
cv::Mat1f areoles(cv::Size size, double cell, quint64 seed) {
  cv::Mat1f field(size);
  const auto site = [&](int cx, int cy) {
    const auto x = static_cast<std::uint32_t>(cx + 8), y = static_cast<std::uint32_t>(cy + 8);
    return cv::Point2f((cx + uniform(seed, 71, x, y)) * static_cast<float>(cell),
                       (cy + uniform(seed, 72, x, y)) * static_cast<float>(cell));
  };
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      float first = 1e9f, second = 1e9f;
      const int cx = static_cast<int>(x / cell), cy = static_cast<int>(y / cell);
      for (int j = cy - 1; j <= cy + 1; ++j) {
        for (int i = cx - 1; i <= cx + 1; ++i) {
          const cv::Point2f d = site(i, j) - cv::Point2f(static_cast<float>(x), static_cast<float>(y));
          const float distance = std::sqrt(d.dot(d));
          second = std::min(second, std::max(first, distance));
          first = std::min(first, distance);
        }
      }
      field(y, x) = std::exp(-std::pow((second - first) / (0.16f * static_cast<float>(cell)), 2.f));
    }
  }
  return field;
}

Fields layOut(const LeafOutline& outline, const QTransform& transform, QSize size, quint64 seed) {
  const double unit = std::hypot(transform.m12(), transform.m22());  // px a leaf length
  Fields fields;
  fields.blade = cover(size, [&](QPainter& painter) {
    QPainterPath path;
    path.addPolygon(mapped(transform, outline.blade));
    path.closeSubpath();
    painter.fillPath(path, Qt::white);
  });
  fields.stalk = cover(size, [&](QPainter& painter) {
    strokeTapered(painter, mapped(transform, outline.petiole), 0.021 * unit, 0.026 * unit);
  });
  fields.veins = cover(size, [&](QPainter& painter) {
    for (const DrawnVein& vein : outline.veins) {
      strokeTapered(painter, mapped(transform, vein.points), vein.width * unit, 0.2 * vein.width * unit);
    }
  });
  fields.fine = areoles(fields.blade.size(), 0.022 * unit, seed);
  cv::Mat1b off = fields.veins < 0.5f;
  cv::distanceTransform(off, fields.toVein, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  cv::Mat1b inside = fields.blade > 0.5f;
  cv::distanceTransform(inside, fields.toMargin, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  fields.toVein /= unit;
  fields.toMargin /= unit;
  return fields;
}

/// Pigments by place (leaf_textures.md, 10): chlorophyll leaves the tissue first and the veins last, carotenoid shows
/// then, anthocyanin follows where the leaf reddens, brown comes from the margin and in spots.
Colour tissue(const PaintedLeaf& leaf, const Fields& fields, const cv::Mat1f& coarse, const cv::Mat1f& middle,
              const cv::Mat1f& small, int x, int y) {
  const float grain = 0.6f * coarse(y, x) + 0.3f * middle(y, x);
  const auto autumn = static_cast<float>(leaf.autumn);
  const float nearVein = std::exp(-fields.toVein(y, x) / 0.028f);
  const float chlorophyll = 1 / (1 + std::exp((2.3f * autumn - 0.75f - 0.55f * nearVein + 0.45f * grain) / 0.14f));
  const Colour green = mix({0.17f, 0.33f, 0.09f}, {0.36f, 0.50f, 0.15f}, 0.45f + 0.35f * grain);
  const Colour yellow = mix({0.86f, 0.66f, 0.16f}, {0.93f, 0.78f, 0.30f}, 0.5f + 0.5f * grain);
  const Colour red = mix({0.66f, 0.13f, 0.09f}, {0.86f, 0.33f, 0.12f}, 0.5f + 0.6f * grain);
  const float anthocyanin = static_cast<float>(leaf.redness) * smoothstep(0.30f, 0.75f, autumn + 0.25f * grain);
  Colour colour = mix(mix(yellow, red, anthocyanin), green, chlorophyll);
  const float brown = smoothstep(
      0.55f, 1.f, autumn + 0.5f * std::exp(-fields.toMargin(y, x) / 0.025f) * autumn + 0.22f * middle(y, x) - 0.12f);
  colour = mix(colour, {0.40f, 0.24f, 0.11f}, 0.85f * brown);
  // Tissue bulges between the veins: darker beside a vein, lighter on top, the finest network as relief.
  const float bulge = 1 - std::exp(-fields.toVein(y, x) / 0.02f);
  colour *= 0.86f + 0.17f * bulge + 0.045f * small(y, x) - 0.10f * fields.fine(y, x) * (1 - 0.5f * nearVein);
  const Colour vein =
      mix(mix({0.93f, 0.80f, 0.42f}, {0.80f, 0.42f, 0.22f}, anthocyanin), {0.58f, 0.68f, 0.33f}, chlorophyll);
  return mix(colour, mix(vein, {0.52f, 0.36f, 0.2f}, 0.6f * brown), 0.85f * fields.veins(y, x));
}

}  // namespace

PaintedPhoto paintLeafPhoto(const PaintedLeaf& leaf, quint64 seed, int size) {
  size = std::max(size, 64);
  const LeafOutline outline = drawOutline(leaf.shape, seed);
  const bool broad = leaf.shape == LeafShape::Maple;
  const QSize frame(broad ? size * 15 / 16 : size * 3 / 4, size);
  RandomSequence random(seed, 23);
  const QTransform transform = fit(outline, frame, random.uniform(-7, 7));
  const double unit = std::hypot(transform.m12(), transform.m22());
  const Fields fields = layOut(outline, transform, frame, seed);

  const cv::Size area = fields.blade.size();
  const cv::Mat1f coarse = noise(area, 0.22 * unit, seed, 31), middle = noise(area, 0.06 * unit, seed, 32),
                  small = noise(area, 0.008 * unit + 1.5, seed, 33), paper = noise(area, 1.6, seed, 34);
  cv::Mat1f body = cv::max(fields.blade, fields.stalk), shadow;
  const double soft = 0.012 * unit + 1;
  cv::GaussianBlur(body, shadow, {}, soft);
  const cv::Mat shift = (cv::Mat_<double>(2, 3) << 1, 0, 0.8 * soft, 0, 1, 1.1 * soft);
  cv::warpAffine(shadow, shadow, shift, area);

  PaintedPhoto result;
  result.photo = QImage(frame, QImage::Format_RGB32);
  result.mask = QImage(frame, QImage::Format_Grayscale8);
  for (int y = 0; y < area.height; ++y) {
    auto* row = reinterpret_cast<QRgb*>(result.photo.scanLine(y));
    uchar* white = result.mask.scanLine(y);
    for (int x = 0; x < area.width; ++x) {
      const float dx = static_cast<float>(x) / static_cast<float>(area.width) - 0.4f;
      const float dy = static_cast<float>(y) / static_cast<float>(area.height) - 0.4f;
      const Colour ground = Colour(0.925f, 0.915f, 0.89f) * (1.f - 0.09f * (dx * dx + dy * dy) + 0.008f * paper(y, x)) *
                            (1.f - 0.38f * shadow(y, x));
      Colour colour = ground;
      if (fields.stalk(y, x) > 0) {
        const float turned = smoothstep(0.2f, 0.7f, static_cast<float>(leaf.autumn));
        const Colour stalk =
            mix({0.50f, 0.60f, 0.26f},
                mix({0.78f, 0.60f, 0.28f}, {0.60f, 0.22f, 0.14f}, static_cast<float>(leaf.redness)), turned);
        colour = mix(colour, stalk * (0.95f + 0.08f * small(y, x)), fields.stalk(y, x));
      }
      if (fields.blade(y, x) > 0) {
        colour = mix(colour, tissue(leaf, fields, coarse, middle, small, x, y), fields.blade(y, x));
      }
      const auto byte = [](float v) { return static_cast<int>(std::lround(255 * std::clamp(v, 0.f, 1.f))); };
      row[x] = qRgb(byte(colour[0]), byte(colour[1]), byte(colour[2]));
      white[x] = body(y, x) >= 0.5f ? 255 : 0;
    }
  }
  result.root = transform.map(QPointF(0, 0));
  double farthest = 0;
  for (const QPointF& point : outline.blade) {
    const QPointF place = transform.map(point), d = place - result.root;
    if (const double distance = QPointF::dotProduct(d, d); distance > farthest) {
      farthest = distance;
      result.tip = place;
    }
  }
  return result;
}

}  // namespace windfall::model
