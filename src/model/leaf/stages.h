// From a photo to its structure, stage by stage; each stage can be computed, looked at and timed alone.
#pragma once

#include <QImage>
#include <QPointF>
#include <QRect>
#include <QSize>
#include <QString>
#include <algorithm>
#include <map>
#include <vector>

#include "model/leaf/leaf.h"
#include "model/progress.h"
#include "sim/result.h"

namespace windfall::model {

/// A number a pixel, row by row.
struct ScalarField {
  QSize size;
  std::vector<float> values;
  double unit = 1;  ///< what a value of 1 stands for: cost of the way, working pixels
};

/// A region a pixel: 0 outside, 1.. regions.
struct LabelField {
  QSize size;
  std::vector<qint32> values;
  int count = 0;
  int petiole = 0;  ///< the label that is the petiole, the last one; 0: there is none
  /// Where several leaves stand in one field: pixels of the leaf that each region is part of; empty: of them all.
  std::vector<double> wholes{};
};

/// What colours are read and placed by: where a pixel lies in its leaf.
struct LeafStructure {
  ScalarField distance;      ///< structural distance, 0..1 (99.5 percentile), 0 outside
  ScalarField veinDistance;  ///< distance to the nearest vein over twice its 95th percentile
  LabelField regions;
  LabelField superpixels;
};

// GCC 12 takes the scoped Stage::Veins for a shadow of the type of that name.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wshadow"
/// Maps and Atlas are made from the variants, not by computeStages.
enum class Stage { Photo, Mask, Contour, Veins, Distance, Regions, Superpixels, Variants, Maps, Atlas };
#pragma GCC diagnostic pop

/// One of the leaves that stand side by side as one example (joinExamples).
struct JoinedLeaf {
  AssetId id;
  QRect place;         ///< its working image in the whole, working pixels
  QRect frame;         ///< its own, pixels of its photo
  double scale = 1;    ///< its own: working pixels a pixel of its photo
  QPointF root, tip;   ///< working pixels of the whole
  int before = 0;      ///< its region n is the whole's region before + n, but for petioles, which are all the last one
  int regions = 0;     ///< how many it has, the petiole too
  bool stalk = false;  ///< its last one is a petiole

  /// A place of its photo in working pixels of the whole.
  QPointF toWhole(QPointF photo) const { return (photo - frame.topLeft()) * scale + place.topLeft(); }
};

/// What was derived from a leaf. Working images and variants cover `frame`, the leaf's part of the photo, with the long
/// side `parameters.synthesis.size`: a small leaf on a large sheet gets a whole texture. Contour, root, tip, veins and
/// markers are in photo pixels, fields and labels in working pixels.
struct LeafStages {
  QImage photo;                  ///< RGBA8888, EXIF rotation applied, photo size
  QImage mask;                   ///< Grayscale8, photo size
  QRect frame;                   ///< what the working images show, photo pixels; the whole photo up to Stage::Mask
  double scale = 1;              ///< working pixels a photo pixel
  std::vector<QPointF> border;   ///< every border pixel in order, counter-clockwise seen with y up
  std::vector<QPointF> contour;  ///< simplified by RDP
  QPointF root, tip;
  Veins veins;
  std::vector<QPointF> petiole;    ///< from its free end to the root; empty where there is none
  QImage alpha;                    ///< Grayscale8, working size: the mask with a soft margin
  std::vector<QPointF> markers;    ///< in photo pixels, those that were used
  LeafStructure grown;             ///< by the veins of this asset: the shape of new textures
  LeafStructure seen;              ///< by the veins that the photo shows: where colours come from (Stage::Superpixels)
  double bladeLength = 0.08;       ///< m, root to tip: by the ruler where there is one
  std::vector<JoinedLeaf> joined;  ///< empty: one leaf
  Leaf made;                       ///< what all this was computed from, but for its variants
  Stage reached = Stage::Photo;
  std::map<QString, double> seconds;  ///< wall clock of each stage by name, of the last time that it was computed
  std::vector<Stage> computed;        ///< what the last call did not find up to date

  /// A place of the photo in working pixels, and back.
  QPointF toWorking(QPointF place) const { return (place - frame.topLeft()) * scale; }
  QPointF toPhoto(QPointF working) const { return working / scale + frame.topLeft(); }
  /// A place of the photo in a variant of any size.
  QPointF toVariant(QPointF place, QSize variant) const {
    return (place - frame.topLeft()) * (static_cast<double>(variant.width()) / std::max(1, frame.width()));
  }
};

/// Reads a picture (JPEG, PNG, 8 or 16 bit) as RGBA8888 with EXIF rotation applied.
Result<QImage> readPhoto(const SourceFile& file);

/// Computes every stage up to `last`. An error says which stage found what ("no leaf found: …"). Of `known`, an earlier
/// result of the same or another leaf, every part is taken over whose own inputs are equal.
Result<LeafStages> computeStages(const Leaf& leaf, Stage last, Progress& progress, const LeafStages* known = nullptr);

/// The shape of another leaf of the same kind, by the shape parameters and `seed`: outline, veins, distances, regions
/// in the same frame, with root and tip where they were. Its `seen` is empty: it is a target for colours of `of`.
Result<LeafStages> computeVariedStages(const LeafStages& of, quint64 seed, Progress& progress);

/// A new texture in the shape of `target` with the colours of `example` (often the same leaf): RGBA, straight alpha,
/// colours spread under the transparent pixels, long side `target parameters.synthesis.size`. Deterministic by seed.
Result<QImage> synthesize(const LeafStages& target, const LeafStages& example, const SynthesisParameters& parameters,
                          quint64 seed, Progress& progress);

/// The picture of one stage, photo size, to be laid over the photo: mask tint, contour and points, veins, distance as
/// colours, regions, superpixels.
QImage stagePicture(const LeafStages& stages, Stage stage);

}  // namespace windfall::model
