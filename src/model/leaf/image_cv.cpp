#include <opencv2/imgproc.hpp>

#include "model/leaf/image_cv_private.h"

namespace windfall::model {

cv::Mat3f toLab(const QImage& rgba) {
  cv::Mat3f rgb, lab;
  cv::Mat3b bytes;
  cv::cvtColor(rgbaView(rgba), bytes, cv::COLOR_RGBA2RGB);
  bytes.convertTo(rgb, CV_32F, 1 / 255.0);
  cv::cvtColor(rgb, lab, cv::COLOR_RGB2Lab);
  return lab;
}

QImage fromLab(const cv::Mat3f& lab, const cv::Mat1b& alpha) {
  cv::Mat3f rgb;
  cv::cvtColor(lab, rgb, cv::COLOR_Lab2RGB);
  cv::Mat3b bytes;
  rgb.convertTo(bytes, CV_8U, 255.0);
  cv::Mat4b pixels(lab.size());
  const cv::Mat sources[] = {bytes, alpha};
  const int from[] = {0, 0, 1, 1, 2, 2, 3, 3};
  cv::mixChannels(sources, 2, &pixels, 1, from, 4);
  return toRgba(pixels);
}

}  // namespace windfall::model
