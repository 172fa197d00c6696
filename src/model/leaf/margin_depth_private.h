// How deep in a leaf its places lie; private to model.
#pragma once

#include <opencv2/imgproc.hpp>

namespace windfall::model {

/// Distance of every place of a mask (255 leaf) from the margin, px; the picture ends in ground. `exactness`: one of
/// cv::DistanceTransformMasks.
inline cv::Mat1f marginDepth(const cv::Mat1b& leaf, int exactness) {
  cv::Mat1b framed;
  cv::copyMakeBorder(leaf, framed, 1, 1, 1, 1, cv::BORDER_CONSTANT, 0);
  cv::Mat1f depth;
  cv::distanceTransform(framed, depth, cv::DIST_L2, exactness);
  return depth(cv::Rect(1, 1, leaf.cols, leaf.rows));
}

/// Radius of the largest disc in a mask, px.
inline double innerRadius(const cv::Mat1f& depth) {
  double deepest = 0;
  cv::minMaxLoc(depth, nullptr, &deepest);
  return deepest;
}

}  // namespace windfall::model
