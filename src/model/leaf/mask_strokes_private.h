// Pen strokes in a found mask; private to model.
#pragma once

#include <opencv2/core.hpp>

namespace windfall::model {

/// Takes thin parts as of ink out of a mask (255 leaf): blue, or black on a leaf that is lighter; writing on the paper
/// that runs into the leaf. Petioles have a colour or are lighter, and stay; a leaf without colour is left as it is.
void dropStrokes(const cv::Mat3f& lab, cv::Mat1b& mask);

}  // namespace windfall::model
