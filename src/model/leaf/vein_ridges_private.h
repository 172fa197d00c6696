// Ridges of lightness on a blade: where its veins show; private to model.
#pragma once

#include <opencv2/core.hpp>

namespace windfall::model {

struct VeinRidges {
  cv::Mat1f strength;  ///< 0..about 1 (99.5th percentile), 0 near the margin and off the leaf
  cv::Mat1f angle;     ///< along the ridge, radians
  float contrast = 0;  ///< what a strength of 1 is, in lightness
};

/// Of a Lab picture about 512 px large; bright veins or dark ones, whichever stand out. `leaf`: 255 on the blade.
VeinRidges veinRidges(const cv::Mat3f& lab, const cv::Mat1b& leaf);

/// The light that comes round a margin, or a cut's, looks like a ridge that runs along it: such ridges go. Veins meet
/// the margin at an angle. Not for finding where the veins meet: beside a deep sinus they run along it.
void dropMarginEdges(VeinRidges& ridges, const cv::Mat1b& leaf);

}  // namespace windfall::model
