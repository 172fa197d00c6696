// Edits of a whole mask, and fills.
#pragma once

#include <QImage>
#include <QPoint>
#include <vector>

namespace windfall::model {

/// Wider by `pixels` all round; narrower where negative. Masks are Grayscale8, white leaf.
QImage grownMask(const QImage& mask, int pixels);
QImage invertedMask(const QImage& mask);
/// Without any hole.
QImage filledMask(const QImage& mask);

/// Sets to `value` what is connected with `at`, has its side of the mask, and a colour within `tolerance` (Delta E) of
/// the photo's there: a click on ground inside a hole fills that hole. `photo` RGBA8888 of the mask's size.
QImage floodedMask(const QImage& mask, const QImage& photo, QPoint at, double tolerance, int value);

/// Scribbles of the artist on a photo: what is surely leaf, and what is surely ground.
struct Scribble {
  std::vector<QPointF> points;  ///< px
  double width = 8;             ///< px
  bool leaf = true;
};

/// The mask that agrees with the scribbles, by GrabCut (Rother and others 2004) from `mask` as the first guess: colours
/// of leaf and ground are learned, and the border runs along edges. Only what changes its side is changed, margins
/// elsewhere stay as they are. `photo` RGBA8888 of the mask's size.
QImage refinedMask(const QImage& mask, const QImage& photo, const std::vector<Scribble>& scribbles);

/// Every leaf of a photo with several, as masks of its size, largest first: what the ground leaves over, of similar
/// size as the largest and not running out of the picture. Leaves that touch come apart where that is sure, and where
/// the artist cut the mask through. `found`: the mask of one of them, or of some that touch. One entry: there is one
/// leaf.
std::vector<QImage> separateLeaves(const QImage& photo, const QImage& found);

/// How many leaves one mask shows, apart or touching; 1 where that is not sure.
int leavesInMask(const QImage& mask);

}  // namespace windfall::model
