// Outlines of other leaves of the same kind.
#pragma once

#include "model/leaf/stages.h"

namespace windfall::model {

/// Ground around a leaf whose outline varies, share of its long side: new outlines may be wider.
inline constexpr double kShapeRoom = 1.0 / 7;

/// A smooth map of the photo's plane that keeps the root and the way to the tip, and turns a leaf into another of its
/// kind: width by `aspect`, halves by `asymmetry`, waves by `lobes`, teeth; drawn by seed. `strength` 0 is the
/// identity. `size` below 1 shrinks the result about the root.
class ShapeMap {
 public:
  ShapeMap(const ShapeParameters& parameters, QPointF root, QPointF tip, quint64 seed, double strength = 1,
           double size = 1);
  QPointF map(QPointF photo) const;
  QPointF unmap(QPointF varied) const;

 private:
  /// Factor of the distance from the axis; `along` 0 root, 1 tip.
  double width(double along, bool left) const;
  double shifted(double along) const;
  double unshifted(double along) const;
  double bend(double along) const;

  struct Wave {
    double amplitude = 0, count = 1, phase = 0;
  };
  double waves(const Wave (&of)[3], double along) const;

  QPointF root_, axis_;
  double length_ = 1, size_ = 1;
  double scale_[2] = {1, 1};
  Wave lobes_[2][3];
  Wave shift_[3];
  double teeth_ = 0, toothPhase_[2] = {0, 0}, bend_ = 0;
  int toothCount_ = 1;
};

/// The leaf of `of` with an outline by its shape parameters and `seed`: mask, root, tips and markers are given, veins
/// too where they were drawn by hand or read from the photo; else they will grow by a seed of their own. The outline
/// stays inside `of.frame`, smaller where it has to, and less varied where that is not enough.
Leaf variedLeaf(const LeafStages& of, quint64 seed);

}  // namespace windfall::model
