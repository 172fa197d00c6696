#include "model/leaf/working_colours.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "model/leaf/dilate.h"
#include "model/leaf/image_cv_private.h"

namespace windfall::model {

std::vector<float> workingColours(const LeafStages& stages) {
  const QSize size = stages.grown.distance.size;
  QImage photo = stages.photo;
  const int margin = std::max(2, std::max(stages.frame.width(), stages.frame.height()) / 340);
  cv::Mat1b solid;
  cv::erode(grayView(stages.mask), solid,
            cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * margin + 1, 2 * margin + 1}), {-1, -1}, 1,
            cv::BORDER_CONSTANT, 0);
  if (cv::countNonZero(solid) == 0) solid = grayView(stages.mask).clone();
  cv::Mat4b pixels = rgbaView(photo).clone();
  for (int y = 0; y < pixels.rows; ++y) {
    for (int x = 0; x < pixels.cols; ++x) pixels(y, x)[3] = solid(y, x);
  }
  const QRect& f = stages.frame;
  pixels = pixels(cv::Rect(f.x(), f.y(), f.width(), f.height()));
  const cv::Mat4b spread = rgbaView(spreadColours(toRgba(pixels))).clone();
  cv::Mat4b sized;
  const bool smaller = size.width() < f.width();
  cv::resize(spread, sized, {size.width(), size.height()}, 0, 0, smaller ? cv::INTER_AREA : cv::INTER_CUBIC);
  const cv::Mat3f lab = toLab(toRgba(sized));
  return {reinterpret_cast<const float*>(lab.datastart), reinterpret_cast<const float*>(lab.dataend)};
}

}  // namespace windfall::model
