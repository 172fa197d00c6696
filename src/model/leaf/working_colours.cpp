#include "model/leaf/working_colours.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "model/leaf/dilate.h"
#include "model/leaf/image_cv_private.h"
#include "model/leaf/lending_private.h"

namespace windfall::model {

namespace {

/// Spreads the colours of `solid` pixels over all others: on the leaf mirrored at the nearest solid one, so that its
/// texture goes on, elsewhere that one's own.
void spread(cv::Mat4b& pixels, const cv::Mat1b& solid, const cv::Mat1b& mask) {
  for (int y = 0; y < pixels.rows; ++y) {
    for (int x = 0; x < pixels.cols; ++x) pixels(y, x)[3] = solid(y, x);
  }
  const std::vector<std::int32_t> nearest = nearestSolid(toRgba(pixels));
  if (nearest.empty()) return;
  const cv::Mat4b before = pixels.clone();
  auto from = nearest.begin();
  for (int y = 0; y < pixels.rows; ++y) {
    for (int x = 0; x < pixels.cols; ++x, ++from) {
      if (solid(y, x)) continue;
      const int nx = *from % pixels.cols, ny = *from / pixels.cols;
      const cv::Point mirrored(2 * nx - x, 2 * ny - y);
      const bool goesOn = mask(y, x) && cv::Rect({}, solid.size()).contains(mirrored) && solid(mirrored);
      pixels(y, x) = goesOn ? before(mirrored) : before(ny, nx);
    }
  }
}

}  // namespace

std::vector<float> workingColours(const LeafStages& stages) {
  const QSize size = stages.grown.distance.size;
  const QRect& f = stages.frame;
  const int margin = std::max(2, std::max(f.width(), f.height()) / 340);
  const QImage photo = stages.photo.copy(f);
  const cv::Mat1b mask = grayView(stages.mask)(cv::Rect(f.x(), f.y(), f.width(), f.height())) > 127;
  Polygon petiole;
  for (const QPointF& p : stages.petiole) petiole.push_back(p - f.topLeft());
  cv::Mat4b pixels = rgbaView(photo).clone();
  spread(pixels, lendingPixels(photo, mask, margin, petiole), mask);
  cv::Mat4b sized;
  const bool smaller = size.width() < f.width();
  cv::resize(pixels, sized, {size.width(), size.height()}, 0, 0, smaller ? cv::INTER_AREA : cv::INTER_CUBIC);
  const cv::Mat3f lab = toLab(toRgba(sized));
  return {reinterpret_cast<const float*>(lab.datastart), reinterpret_cast<const float*>(lab.dataend)};
}

}  // namespace windfall::model
