// Which pixels of a leaf's photo show the leaf and nothing else; private to model.
#pragma once

#include <QImage>
#include <opencv2/core.hpp>

#include "model/leaf/contour.h"

namespace windfall::model {

/// 255 where a photo (RGBA8888) shows the leaf of `mask` (its size, 255 leaf) surely: `margin` px inside its outline,
/// and not where the ground shows through a small hole or looks over the margin, nor where a shadow lies along it, as
/// the blade's and the ground's colours around tell. The petiole is not judged: nothing around has its colour. px.
cv::Mat1b lendingPixels(const QImage& photo, const cv::Mat1b& mask, int margin, const Polygon& petiole);

}  // namespace windfall::model
