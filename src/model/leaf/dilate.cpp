#include "model/leaf/dilate.h"

#include <opencv2/imgproc.hpp>

#include "model/leaf/image_cv_private.h"

namespace windfall::model {

std::vector<std::int32_t> nearestSolid(const QImage& image, int solid) {
  const cv::Mat4b pixels = rgbaView(image);
  cv::Mat1b open(pixels.size());
  int known = 0;
  for (int y = 0; y < pixels.rows; ++y) {
    for (int x = 0; x < pixels.cols; ++x) {
      open(y, x) = pixels(y, x)[3] >= solid ? 0 : 255;
      known += open(y, x) == 0;
    }
  }
  if (known == 0) return {};
  cv::Mat1f distance;
  cv::Mat1i nearest;
  cv::distanceTransform(open, distance, nearest, cv::DIST_L2, 5, cv::DIST_LABEL_PIXEL);
  std::vector<std::int32_t> ofLabel(static_cast<size_t>(known) + 1, 0);
  std::vector<std::int32_t> result(pixels.total());
  const auto at = [&](int x, int y) { return static_cast<std::int32_t>(y * pixels.cols + x); };
  for (int y = 0; y < pixels.rows; ++y) {
    for (int x = 0; x < pixels.cols; ++x) {
      if (open(y, x)) continue;
      const auto label = static_cast<size_t>(nearest(y, x));
      if (label >= ofLabel.size()) ofLabel.resize(label + 1);
      ofLabel[label] = at(x, y);
    }
  }
  for (int y = 0; y < pixels.rows; ++y) {
    for (int x = 0; x < pixels.cols; ++x) {
      result[static_cast<size_t>(at(x, y))] = open(y, x) ? ofLabel[static_cast<size_t>(nearest(y, x))] : at(x, y);
    }
  }
  return result;
}

void spreadFrom(const std::vector<std::int32_t>& nearest, QImage& image) {
  const int width = image.width();
  if (nearest.size() != static_cast<size_t>(width) * static_cast<size_t>(image.height())) return;
  image.detach();
  // Solid pixels name themselves, so that nothing is read after it was overwritten.
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < width; ++x) {
      const std::int32_t from = nearest[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)];
      const int fx = from % width, fy = from / width;
      if (fx == x && fy == y) continue;
      if (image.format() == QImage::Format_Grayscale16) {
        reinterpret_cast<quint16*>(image.scanLine(y))[x] =
            reinterpret_cast<const quint16*>(image.constScanLine(fy))[fx];
      } else if (image.format() == QImage::Format_Grayscale8) {
        image.scanLine(y)[x] = image.constScanLine(fy)[fx];
      } else {
        const uchar* source = image.constScanLine(fy) + 4 * fx;
        std::copy(source, source + 3, image.scanLine(y) + 4 * x);
      }
    }
  }
}

QImage spreadColours(const QImage& image, int solid) {
  QImage result = image.convertToFormat(QImage::Format_RGBA8888);
  spreadFrom(nearestSolid(result, solid), result);
  return result;
}

}  // namespace windfall::model
