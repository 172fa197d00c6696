// A leaf asset: the photo, what the artist marked on it, and the numbers that shape new textures.
#pragma once

#include <QImage>
#include <QPointF>
#include <QString>
#include <optional>
#include <vector>

#include "model/ids.h"
#include "model/leaf/ageing.h"
#include "model/leaf/maps.h"
#include "model/leaf/vein.h"
#include "model/source_file.h"

namespace windfall::model {

/// Growth of veins by seed (leaf_textures.md, 3). Lengths are shares of the image's long side.
struct VeinParameters {
  quint64 seed = 1;
  int laterals = 8;         ///< a side
  double basalAngle = 62;   ///< degrees from the main vein at the base
  double apicalAngle = 35;  ///< degrees at the tip
  double wiggle = 15;       ///< degrees, largest turn of a step
  bool operator==(const VeinParameters&) const = default;
};

/// Costs of a step of the structural distance (leaf_textures.md, 4).
struct DistanceCosts {
  int veinVein = 1, veinTissue = 4, tissueTissue = 8;
  bool operator==(const DistanceCosts&) const = default;
};

/// How new textures are made: guided by patches that lie along the veins (leaf_textures.md, 9b), or classic:
/// superpixels matched by region and distance, smoothed, with a layer of detail (6 to 9a).
struct SynthesisParameters {
  bool guided = true;
  int size = 1024;            ///< long side of the result, px
  double guideWeight = 1000;  ///< guided: how much the place in the leaf counts beside the colours of patches
  int superpixels = 16384;    ///< wanted on the blade at the finest level
  int levels = 3;             ///< of superpixels, each a few times as many as the one before; 1..5
  int candidates = 8;         ///< N: nearest in structural and vein distance
  int choices = 2;            ///< M: drawn from them; the one whose colour is nearest to the coarser level's is taken
  double smoothing = 1.0;     ///< w1
  bool detail = true;         ///< the example's fine detail on top
  bool operator==(const SynthesisParameters&) const = default;
};

struct LeafParameters {
  double epsilon = 0;  ///< RDP tolerance in px; 0: 1/256 of the long side
  VeinParameters veins;
  DistanceCosts costs;
  SynthesisParameters synthesis;
  MapParameters maps;
  AgeingParameters ageing;
  bool operator==(const LeafParameters&) const = default;
};

/// One new texture; its picture follows from the seed and is kept so that it need not be made again.
struct Variant {
  quint64 seed = 0;
  bool keep = true;  ///< goes into the atlas and onto the trees
  QImage image;      ///< RGBA, straight alpha, photo orientation
  bool operator==(const Variant&) const = default;
};

/// Marks that are empty are found automatically from what stands above them.
struct Leaf {
  AssetId id;
  QString name;
  SourceFile photo;
  QImage mask;                   ///< Grayscale8 of the photo's size, white leaf; null: automatic
  std::optional<QPointF> root;   ///< where the petiole meets the blade, px
  Veins veins;                   ///< drawn by hand; empty: grown
  std::vector<QPointF> markers;  ///< region markers, px; empty: automatic
  double bladeLength = 0.08;     ///< m, root to tip
  LeafParameters parameters;
  std::vector<Variant> variants;
  bool operator==(const Leaf&) const = default;
};

}  // namespace windfall::model
