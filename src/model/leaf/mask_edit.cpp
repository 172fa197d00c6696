#include "model/leaf/mask_edit.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "model/leaf/image_cv_private.h"

namespace windfall::model {

QImage grownMask(const QImage& mask, int pixels) {
  if (pixels == 0) return mask;
  const int radius = std::abs(pixels);
  const cv::Mat disc = cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * radius + 1, 2 * radius + 1});
  cv::Mat1b result;
  // Beyond the picture there is no leaf: narrowing works at its border too.
  if (pixels > 0) {
    cv::dilate(grayView(mask), result, disc);
  } else {
    cv::erode(grayView(mask), result, disc, {-1, -1}, 1, cv::BORDER_CONSTANT, 0);
  }
  return toGray(result);
}

QImage invertedMask(const QImage& mask) { return toGray(~grayView(mask)); }

QImage filledMask(const QImage& mask) {
  cv::Mat1b result = grayView(mask) > 127;
  std::vector<std::vector<cv::Point>> outlines;
  cv::findContours(result, outlines, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  cv::drawContours(result, outlines, -1, 255, cv::FILLED);
  return toGray(result);
}

QImage floodedMask(const QImage& mask, const QImage& photo, QPoint at, double tolerance, int value) {
  if (!mask.valid(at) || photo.size() != mask.size()) return mask;
  const cv::Mat1b before = grayView(mask) > 127;
  const cv::Mat3f lab = toLab(photo);
  const cv::Point start(at.x(), at.y());
  // One pixel of a photo says little: the mean of its neighbours is what was meant.
  const cv::Rect around = cv::Rect(start.x - 1, start.y - 1, 3, 3) & cv::Rect(0, 0, lab.cols, lab.rows);
  const cv::Scalar mean = cv::mean(lab(around));
  const cv::Vec3f wanted(static_cast<float>(mean[0]), static_cast<float>(mean[1]), static_cast<float>(mean[2]));
  cv::Mat1b alike(before.size());
  for (int y = 0; y < lab.rows; ++y) {
    for (int x = 0; x < lab.cols; ++x) {
      alike(y, x) = before(y, x) == before(start) && cv::norm(lab(y, x) - wanted) <= tolerance ? 255 : 0;
    }
  }
  alike(start) = 255;
  cv::Mat1b filled(lab.rows + 2, lab.cols + 2, static_cast<uchar>(0));
  cv::floodFill(alike, filled, start, 255, nullptr, 0, 0, 4 | cv::FLOODFILL_MASK_ONLY | (255 << 8));
  cv::Mat1b part = filled(cv::Rect(1, 1, lab.cols, lab.rows)).clone();
  // Noise inside the filled part belongs to it.
  cv::morphologyEx(part, part, cv::MORPH_CLOSE, cv::getStructuringElement(cv::MORPH_ELLIPSE, {5, 5}));
  cv::Mat1b result = grayView(mask).clone();
  result.setTo(value, part);
  return toGray(result);
}

}  // namespace windfall::model
