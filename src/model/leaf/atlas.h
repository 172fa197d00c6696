// Leaf textures turned upright, and packed together.
#pragma once

#include <QImage>
#include <QJsonObject>
#include <QPointF>
#include <QRect>
#include <QSizeF>
#include <QString>
#include <vector>

#include "sim/result.h"

namespace windfall::model {

/// A texture ready for a tree: the petiole's end at the bottom, the tip up.
struct LeafTexture {
  QString name;
  QImage image;   ///< RGBA8888, straight alpha, colours spread outwards
  QPointF pivot;  ///< petiole's end in shares of the image, top left (0, 0)
  QSizeF metres;  ///< real size of the whole image
};

/// Turns a variant so that root to tip points up, and crops it to the leaf.
LeafTexture uprightTexture(const QString& name, const QImage& variant, QPointF root, QPointF tip, double bladeLength);

struct AtlasSettings {
  int size = 2048;   ///< power of two
  int padding = 16;  ///< px between leaves, filled with the leaves' own colours
};

struct Atlas {
  QImage image;               ///< RGBA8888, straight alpha
  std::vector<QRect> places;  ///< of the textures, in order, px
  std::vector<LeafTexture> textures;
};

/// Packs and dilates; textures are scaled down together when they do not fit.
Result<Atlas> packAtlas(std::vector<LeafTexture> textures, const AtlasSettings& settings);

/// Rectangles, pivots, sizes in metres.
QJsonObject describe(const Atlas& atlas);

}  // namespace windfall::model
