// Lines one pixel wide; private to model.
#pragma once

#include <opencv2/core.hpp>

namespace windfall::model {

/// Thins what is not 0 to its middle lines, 8-connected, 255 on 0 (Zhang and Suen 1984). The outermost pixels of the
/// picture count as empty.
cv::Mat1b thinned(const cv::Mat1b& shape);

}  // namespace windfall::model
