// Parts of the quality score; private to it.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "model/leaf/quality.h"
#include "model/leaf/quantiles.h"

namespace windfall::model {

/// A leaf as the score measures it: the mask without its outermost pixels, colours, distance to the nearest vein.
struct MeasuredLeaf {
  cv::Mat1b leaf;  ///< 255 inside
  cv::Mat3f lab;
  cv::Mat1f distance;  ///< structural
  cv::Mat1f toVein;    ///< px of a picture of 512
  double unit = 1;     ///< pixels of this picture a pixel of one of 512
};

MeasuredLeaf measureLeaf(const ScoredLeaf& leaf);

/// Gaussian mean over the leaf alone, as far as the leaf reaches; `sigma` in pixels.
cv::Mat maskedBlur(const cv::Mat& values, const cv::Mat1b& leaf, double sigma);

/// 7 x 7 patches of one scale, reduced to their 24 main components (C).
class PatchSamples {
 public:
  static constexpr int kScales = 3, kWanted = 4000;

  explicit PatchSamples(const MeasuredLeaf& example);
  struct Ratios {
    double coherence = 1, completeness = 1;
  };
  Ratios compare(const MeasuredLeaf& made) const;

 private:
  struct Scale {
    cv::Mat1f basis, mean;   ///< rows: components; one row
    cv::Mat1f known, asked;  ///< a row a patch
    double within95 = 1, withinMean = 1;
  };
  std::vector<Scale> scales_;
};

}  // namespace windfall::model
