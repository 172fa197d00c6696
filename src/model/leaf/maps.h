// What a leaf's surface is like beside its colour: relief, gloss, how much light comes through.
#pragma once

#include <QImage>
#include <QPointF>

#include "model/leaf/vein.h"

namespace windfall::model {

/// How the maps are made (leaf_textures.md, 10).
struct MapParameters {
  double relief = 1;     ///< of the slopes; glossy leaves have about half
  double gloss = 0.3;    ///< 0 dull .. 1 waxy
  double detail = 0.3;   ///< share of the picture's own fine light and dark in the height
  double thickness = 1;  ///< of the blade: more lets less light through
  bool operator==(const MapParameters&) const = default;
};

/// What maps are made from: a texture and the veins in it, all in the texture's pixels.
struct MapSource {
  QImage image;  ///< RGBA8888, straight alpha
  Veins veins;
  QPointF root;
  quint64 seed = 1;    ///< of the fine grain
  double dryness = 0;  ///< 0 fresh .. 1 dry: dry leaves are dull
};

/// All of the texture's size.
struct LeafMaps {
  QImage height;        ///< Grayscale16 of the upper face: veins are sunken; 0..1 spans the leaf's heights
  QImage normal;        ///< RGBA8888, tangent space, OpenGL (+Y up the picture), alpha of the texture
  QImage roughness;     ///< Grayscale8
  QImage translucency;  ///< RGBA8888: colour of the light that comes through, sRGB, alpha of the texture
  QImage thinness;      ///< Grayscale8: light that comes through, 255 as much as through bare blade
  QImage occlusion;     ///< Grayscale8, 255 open
  QImage ageing;        ///< RGBA8888: when a place loses its green, browns, and how much it reddens (ageing.h)
  double meanTilt = 0, steepTilt = 0;  ///< degrees: mean and 95th percentile of the normals' tilt on the blade
};

LeafMaps makeMaps(const MapSource& source, const MapParameters& parameters);

/// Half the side of a pixel's slope is Sobel over eight; at 512 px a height step of one pixel tilts by 4 (the note's
/// strength).
inline constexpr double kNormalStrength = 4;

}  // namespace windfall::model
