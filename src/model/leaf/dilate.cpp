#include "model/leaf/dilate.h"

#include <opencv2/imgproc.hpp>
#include <vector>

#include "model/leaf/image_cv_private.h"

namespace windfall::model {

QImage spreadColours(const QImage& image, int solid) {
  QImage source = image.convertToFormat(QImage::Format_RGBA8888);
  const cv::Mat4b pixels = rgbaView(source);
  cv::Mat1b open(pixels.size());
  int known = 0;
  for (int y = 0; y < pixels.rows; ++y) {
    for (int x = 0; x < pixels.cols; ++x) {
      open(y, x) = pixels(y, x)[3] >= solid ? 0 : 255;
      known += open(y, x) == 0;
    }
  }
  if (known == 0) return source;
  cv::Mat1f distance;
  cv::Mat1i nearest;
  cv::distanceTransform(open, distance, nearest, cv::DIST_L2, 5, cv::DIST_LABEL_PIXEL);
  std::vector<cv::Vec4b> colour(1);
  for (int y = 0; y < pixels.rows; ++y) {
    for (int x = 0; x < pixels.cols; ++x) {
      if (open(y, x)) continue;
      const auto label = static_cast<size_t>(nearest(y, x));
      if (label >= colour.size()) colour.resize(label + 1);
      colour[label] = pixels(y, x);
    }
  }
  cv::Mat4b result = pixels.clone();
  for (int y = 0; y < pixels.rows; ++y) {
    for (int x = 0; x < pixels.cols; ++x) {
      if (!open(y, x)) continue;
      cv::Vec4b spread = colour[static_cast<size_t>(nearest(y, x))];
      spread[3] = pixels(y, x)[3];
      result(y, x) = spread;
    }
  }
  return toRgba(result);
}

}  // namespace windfall::model
