// Leaf textures turned upright with their maps and meshes, and packed together.
#pragma once

#include <QImage>
#include <QJsonObject>
#include <QPointF>
#include <QRect>
#include <QSizeF>
#include <QString>
#include <QTransform>
#include <vector>

#include "model/leaf/atlas_settings.h"
#include "model/leaf/leaf.h"
#include "model/leaf/leaf_mesh.h"
#include "model/leaf/maps.h"
#include "model/progress.h"
#include "sim/result.h"

namespace windfall::model {

/// A texture ready for a tree: the petiole's end at the bottom, the tip up.
struct LeafTexture {
  QString name;
  QImage image;   ///< RGBA8888, straight alpha, colours spread outwards
  QPointF pivot;  ///< petiole's end in shares of the image, top left (0, 0)
  QSizeF metres;  ///< real size of the whole image

  QTransform toTexture{};     ///< pixels of the variant to pixels of the image
  QPointF root{};             ///< where the blade begins, px of the image
  Veins veins{};              ///< px of the image
  LeafMaps maps{};            ///< null images until `dressTexture`
  LeafMeshes meshes{};        ///< empty until then
  float stalk = 0;            ///< petiole's share of the length from its end to the tip
  float halfWidth = 0.4f;     ///< of the blade, in that length
  AgeingParameters ageing{};  ///< of the leaf that it came from
};

/// Turns a variant so that root to tip points up, and crops it to the leaf. `veins` in the variant's pixels.
LeafTexture uprightTexture(const QString& name, const QImage& variant, QPointF root, QPointF tip, double bladeLength,
                           const Veins& veins = {});

/// Ages its colours as its leaf says, and makes maps and meshes. Error: nothing in the picture is opaque.
Status dressTexture(LeafTexture& texture, const LeafParameters& parameters, quint64 seed);

/// The meshes alone, fitted to the image with the main vein as fold.
Result<LeafMeshes> fitTexture(const LeafTexture& texture);

struct Atlas {
  QImage image;               ///< RGBA8888, straight alpha, colours spread everywhere
  LeafMaps maps;              ///< of the same size; null where no texture has maps
  std::vector<QRect> places;  ///< of the textures, in order, px
  std::vector<bool> turned;   ///< by 90 degrees clockwise: the tip points right
  double scale = 1;           ///< px of the atlas a px of a texture
  std::vector<LeafTexture> textures;

  /// A place in a texture (shares, top left (0, 0)) as a place in the atlas.
  QPointF toAtlas(size_t texture, QPointF share) const;
};

/// Packs and spreads colours; textures are scaled down together when they do not fit or `leafPixels` asks for it. Maps
/// are cleared first: what no leaf covers has the nearest leaf's colour, a flat normal's surroundings, no height.
Result<Atlas> packAtlas(std::vector<LeafTexture> textures, const AtlasSettings& settings);

/// Rectangles, pivots, sizes in metres, meshes: docs/atlas.md describes every key.
QJsonObject describe(const Atlas& atlas);

/// Mip levels 1.. of an atlas: colours averaged in linear light by their alpha, alpha scaled so that as many texels as
/// in the whole picture reach one half (Castano 2010). At most `count`, down to 1 x 1.
std::vector<QImage> mipLevels(const QImage& image, int count);

}  // namespace windfall::model
