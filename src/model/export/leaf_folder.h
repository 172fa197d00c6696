// What `windfall leaf` writes: one leaf's stages and variants as plain files in a folder.
#pragma once

#include <QImage>
#include <QJsonObject>
#include <QString>
#include <map>
#include <vector>

#include "model/leaf/atlas.h"
#include "model/leaf/stages.h"

namespace windfall::model {

/// What goes into the folder.
struct LeafFolder {
  const LeafStages* stages = nullptr;  ///< all of them reached
  double bladeLength = 0.08;           ///< m
  std::vector<quint64> seeds;          ///< of the variants
  std::vector<QImage> variants;
  std::vector<double> variantSeconds;
  std::map<QString, double> otherSeconds;  ///< stages beside the leaf's own: "examples", "compare"
  LeafParameters parameters;               ///< how maps are made and textures aged
  QImage compare;                          ///< compare.png; null: none
};

/// Writes mask.png, contour.json, veins.json, veins.png, distance.png (16 bit), regions.png, superpixels_1.png to
/// superpixels_5.png from coarse to fine, variant_000.png and on, each with its maps (variant_000_normal.png, …) and
/// meshes (variant_000_mesh.json), compare.png, timings.json, and look_*.jpg, the stages laid over the photo. All is
/// made in a folder beside `path` and put in place when it is whole; variants of an earlier run go. `path` is made
/// where it is missing.
Status writeLeafFolder(const LeafFolder& leaf, const QString& path, Progress& progress);

/// The variants of such a folder, turned upright, with maps and meshes.
Result<std::vector<LeafTexture>> readLeafFolder(const QString& path);

}  // namespace windfall::model
