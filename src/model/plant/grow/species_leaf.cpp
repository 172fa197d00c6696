#include "model/plant/grow/species_leaf.h"

#include <QPainter>
#include <algorithm>
#include <cmath>

#include "kernels/random.h"
#include "model/leaf/shape_texture.h"
#include "model/sample/leaf_painter.h"

namespace windfall::model::growth {

namespace {

constexpr int kSize = 384;  ///< px, long side

struct Look {
  LeafShape shape;
  double width;             ///< of the painted leaf's own
  double red, green, blue;  ///< factors on its colours
};

Look lookOf(LeafLook look) {
  switch (look) {
    case LeafLook::Oak:
      return {LeafShape::Oak, 1, 0.78, 0.86, 0.72};
    case LeafLook::Birch:
      return {LeafShape::Serrate, 1.05, 1.02, 1.10, 0.95};
    case LeafLook::Aspen:
      return {LeafShape::Serrate, 1.5, 0.98, 1.10, 1.25};
    case LeafLook::Willow:
      return {LeafShape::Ovate, 0.36, 1.22, 1.20, 1.15};
    case LeafLook::Maple:
      return {LeafShape::Maple, 1, 0.92, 1.02, 0.85};
    case LeafLook::Bush:
      return {LeafShape::Ovate, 1.1, 0.85, 0.95, 0.8};
    case LeafLook::Herb:
      return {LeafShape::Serrate, 0.8, 1.05, 1.15, 0.9};
    default:
      return {LeafShape::Ovate, 1, 1, 1, 1};
  }
}

void tint(QImage& image, const Look& look) {
  for (int y = 0; y < image.height(); ++y) {
    uchar* row = image.scanLine(y);
    for (int x = 0; x < image.width(); ++x) {
      const double factors[] = {look.red, look.green, look.blue};
      for (int k = 0; k < 3; ++k)
        row[4 * x + k] = static_cast<uchar>(std::clamp(row[4 * x + k] * factors[k], 0.0, 255.0));
    }
  }
}

/// Colours of the nearest opaque pixels under the transparent ones, so that no halo appears at the edges.
void spread(QImage& image, const QColor& around) {
  for (int y = 0; y < image.height(); ++y) {
    uchar* row = image.scanLine(y);
    for (int x = 0; x < image.width(); ++x) {
      uchar* p = row + 4 * x;
      if (p[3] > 8) continue;
      p[0] = static_cast<uchar>(around.red()), p[1] = static_cast<uchar>(around.green()),
      p[2] = static_cast<uchar>(around.blue());
    }
  }
}

}  // namespace

QImage needleTwig(bool pine, quint64 seed, int height) {
  // A fir's needles stand in two flat ranks along the twig; a pine's leave the end of a short shoot in a brush.
  const int width = pine ? height * 3 / 4 : height * 5 / 8;
  QImage image(width, height, QImage::Format_ARGB32_Premultiplied);
  image.fill(Qt::transparent);
  QPainter painter(&image);
  painter.setRenderHint(QPainter::Antialiasing);
  const double h = height, cx = 0.5 * width;
  const auto random = [&](std::uint32_t who, std::uint32_t what) {
    return static_cast<double>(uniform(seed, who, what));
  };
  const auto needle = [&](QPointF from, double angle, double length, double thickness, std::uint32_t who) {
    const double shade = 0.75 + 0.5 * random(who, 9);
    const QColor colour = pine ? QColor::fromRgbF(static_cast<float>(0.24 * shade), static_cast<float>(0.36 * shade),
                                                  static_cast<float>(0.17 * shade))
                               : QColor::fromRgbF(static_cast<float>(0.13 * shade), static_cast<float>(0.27 * shade),
                                                  static_cast<float>(0.15 * shade));
    const QPointF tip = from + length * QPointF(std::sin(angle), -std::cos(angle));
    const QPointF middle =
        0.5 * (from + tip) + 0.06 * length * (random(who, 8) - 0.5) * QPointF(std::cos(angle), std::sin(angle));
    painter.setPen(QPen(colour, thickness, Qt::SolidLine, Qt::RoundCap));
    painter.drawLine(from, middle);
    painter.setPen(QPen(colour.lighter(112), 0.75 * thickness, Qt::SolidLine, Qt::RoundCap));
    painter.drawLine(middle, tip);
  };
  painter.setPen(QPen(QColor(96, 74, 48), 0.022 * h, Qt::SolidLine, Qt::RoundCap));
  painter.drawLine(QPointF(cx, h - 2), QPointF(cx, pine ? 0.55 * h : 0.10 * h));
  const int count = pine ? 56 : 74;
  for (int i = 0; i < count; ++i) {
    const auto who = static_cast<std::uint32_t>(i);
    if (pine) {
      const double place = 0.5 + 0.32 * random(who, 1);
      const double angle = (random(who, 2) - 0.5) * 2.1;
      needle({cx, h * place}, angle, h * (0.34 + 0.12 * random(who, 3)) * (1 - 0.15 * std::abs(angle)), 0.012 * h, who);
    } else {
      const int pair = i / 2, pairs = count / 2;
      const double t = (pair + random(who, 1)) / pairs;
      const double side = i % 2 == 0 ? 1 : -1;
      const double angle = side * (1.15 - 0.55 * t + 0.25 * (random(who, 2) - 0.5));
      const double length = h * (0.21 + 0.05 * random(who, 3)) * (0.55 + 0.45 * std::sin(3.14159 * (0.12 + 0.8 * t)));
      needle({cx, h * (0.93 - 0.82 * t)}, angle, length, 0.020 * h, who);
    }
  }
  painter.end();
  QImage straight = image.convertToFormat(QImage::Format_RGBA8888);
  spread(straight, pine ? QColor(61, 92, 43) : QColor(33, 69, 38));
  return straight;
}

LeafTexture speciesLeaf(LeafLook look, int variant, double length) {
  const auto seed = static_cast<quint64>(41 + variant + 16 * static_cast<int>(look));
  if (look == LeafLook::Fir || look == LeafLook::Pine) {
    LeafTexture texture;
    texture.name = look == LeafLook::Fir ? QStringLiteral("fir twig") : QStringLiteral("pine twig");
    texture.image = needleTwig(look == LeafLook::Pine, seed, kSize);
    texture.pivot = {0.5, 1};
    texture.metres = {length * texture.image.width() / texture.image.height(), length};
    return texture;
  }
  const Look is = lookOf(look);
  const PaintedPhoto painted = paintLeafPhoto({is.shape, 0, 0}, seed, kSize);
  QImage image = painted.photo.convertToFormat(QImage::Format_RGBA8888);
  image.setAlphaChannel(painted.mask);
  tint(image, is);
  LeafTexture texture = uprightTexture(QStringLiteral("stand-in"), image, painted.root, painted.tip, length);
  if (is.width != 1) {
    const QSize size(std::max(8, static_cast<int>(texture.image.width() * is.width)), texture.image.height());
    texture.image = texture.image.scaled(size, Qt::IgnoreAspectRatio, Qt::SmoothTransformation)
                        .convertToFormat(QImage::Format_RGBA8888);
    texture.metres.rwidth() *= is.width;
  }
  // A painted blade always has an outline.
  static_cast<void>(shapeTexture(texture));
  return texture;
}

}  // namespace windfall::model::growth
