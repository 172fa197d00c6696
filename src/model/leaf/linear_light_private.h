// Pictures for filtering: linear light, premultiplied alpha.
#pragma once

#include <QImage>
#include <opencv2/core.hpp>

namespace windfall::model {

/// RGBA8888 sRGB with straight alpha to linear premultiplied floats 0..1.
cv::Mat4f toLinear(const QImage& rgba);
/// And back; where alpha is 0 the colour is black.
QImage fromLinear(const cv::Mat4f& linear);

}  // namespace windfall::model
