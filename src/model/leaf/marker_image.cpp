#include "model/leaf/marker_image.h"

#include <opencv2/imgproc.hpp>

#include "model/leaf/image_cv_private.h"

namespace windfall::model {

std::vector<QPointF> markersOf(const QImage& spots) {
  const QImage gray = spots.convertToFormat(QImage::Format_Grayscale8);
  const cv::Mat1b white = grayView(gray) > 127;
  cv::Mat labels, stats, centres;
  const int count = cv::connectedComponentsWithStats(white, labels, stats, centres, 8, CV_32S);
  std::vector<QPointF> markers;
  for (int i = 1; i < count; ++i) markers.emplace_back(centres.at<double>(i, 0), centres.at<double>(i, 1));
  return markers;
}

}  // namespace windfall::model
