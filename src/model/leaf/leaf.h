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

/// How the mask is found where the artist gives none.
struct MaskParameters {
  bool keepHoles = true;  ///< places inside the blade that look like ground are holes
  bool operator==(const MaskParameters&) const = default;
};

/// Veins that were not drawn by hand: grown by seed, or read from the photo (leaf_textures.md, 3).
struct VeinParameters {
  quint64 seed = 1;
  bool fromPhoto = false;      ///< the veins that the photo shows, instead of grown ones
  double detail = 0.004;       ///< share of the blade that a vein of the photo must serve
  int mains = 0;               ///< main veins; 0: one for each tip that the outline shows
  int laterals = 8;            ///< a side
  double basalAngle = 62;      ///< degrees from the main vein at the base
  double apicalAngle = 35;     ///< degrees at the tip
  double wiggle = 15;          ///< degrees, largest turn of a step
  double firstLateral = 0.06;  ///< where the laterals begin, share of the main vein
  double lastLateral = 0.86;   ///< and where they end
  double stagger = 0.25;       ///< how far the sides are set off, share of a gap; 0: opposite, 0.5: alternate
  bool leftSide = true, rightSide = true;  ///< which sides have laterals, seen from the root to the tip
  bool bezier = false;         ///< each vein one Bezier curve of its steps, as in the thesis; else a B-spline
  bool micro = false;          ///< tertiary and finer veins between them
  bool closed = true;          ///< the finer veins meet in loops; else they end freely
  double microSpacing = 0.02;  ///< between finer veins, share of the leaf's long side
  bool operator==(const VeinParameters&) const = default;
};

/// How the outline of a new leaf differs from the photo's, by the seed of each variant. All are shares, 0: not at all.
struct ShapeParameters {
  bool vary = false;         ///< every variant gets an outline and veins of its own
  double aspect = 0.12;      ///< of the width
  double asymmetry = 0.10;   ///< of the two halves' widths against each other
  double lobes = 0.06;       ///< of the width, in waves as long as lobes
  double teeth = 0;          ///< of the width, as teeth along the margin
  int toothCount = 24;       ///< a side
  int holes = 0, bites = 0;  ///< at most so many, eaten inside and at the margin
  bool operator==(const ShapeParameters&) const = default;
};

/// How regions of the example are chosen for those of the target (leaf_textures.md, 5).
struct RegionParameters {
  bool scaleFree = true;  ///< areas compared as a ratio of shares; false: in pixels, as in the thesis
  double best = 0.2;      ///< share of the example's regions, by similarity, that one is drawn from
  bool mix = true;        ///< of several examples each region takes its own choice; false: variants take them in turn
  bool hold = false;      ///< the same choice for every variant, by `seed`; only colours are drawn again
  quint64 seed = 1;
  double evenTones = 1;  ///< mixed: how far casts between the examples are taken away, 0..1
  bool operator==(const RegionParameters&) const = default;
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
  bool asThesis = false;  ///< classic: regions and places are matched as in the thesis, by structural distance alone
  double variety = 5;     ///< CIE76: so far variants differ on the mean; what their regions lack of it, tones add
  bool operator==(const SynthesisParameters&) const = default;
};

struct LeafParameters {
  MaskParameters mask;
  double epsilon = 0;  ///< RDP tolerance in px; 0: 1/256 of the long side
  ShapeParameters shape;
  VeinParameters veins;
  DistanceCosts costs;
  RegionParameters regions;
  SynthesisParameters synthesis;
  MapParameters maps;
  AgeingParameters ageing;
  bool operator==(const LeafParameters&) const = default;
};

/// One new texture; its picture follows from the seed and is kept so that it need not be made again.
struct Variant {
  quint64 seed = 0;
  bool keep = true;                  ///< goes into the atlas and onto the trees
  QImage image;                      ///< RGBA, straight alpha, photo orientation
  std::optional<QPointF> root, tip;  ///< px of the image; absent: where the leaf's own stages have them
  bool operator==(const Variant&) const = default;
};

/// Two places of the photo whose distance is known: the leaf's real size follows.
struct Ruler {
  std::optional<QPointF> from, to;  ///< px
  double metres = 0.1;              ///< between them
  bool isSet() const { return from && to && *from != *to; }
  bool operator==(const Ruler&) const = default;
};

/// By hand: the region of the target at one place takes its colours from the region of an example at another.
struct RegionPair {
  QPointF target;   ///< px of this leaf's photo
  AssetId example;  ///< 0: this leaf itself
  QPointF source;   ///< px of the example's photo
  bool operator==(const RegionPair&) const = default;
};

/// Marks that are empty are found automatically from what stands above them.
struct Leaf {
  AssetId id;
  QString name;
  SourceFile photo;
  QImage mask;                          ///< Grayscale8 of the photo's size, white leaf; null: automatic
  std::optional<QPointF> root;          ///< where the petiole meets the blade, px
  std::vector<QPointF> tips;            ///< where the main veins end, px; the first is the tip; empty: automatic
  Veins veins;                          ///< drawn by hand; empty: by the parameters
  std::vector<QPointF> markers;         ///< region markers, px; empty: automatic
  Ruler ruler;                          ///< wins over bladeLength
  double bladeLength = 0.08;            ///< m, root to tip
  std::vector<AssetId> examples;        ///< leaves that lend their colours (RegionParameters::mix); empty: this one
  std::vector<RegionPair> regionPairs;  ///< choices of regions made by hand
  LeafParameters parameters;
  std::vector<Variant> variants;
  bool operator==(const Leaf&) const = default;
};

}  // namespace windfall::model
