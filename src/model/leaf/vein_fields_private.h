// How far every pixel of a leaf is from its veins and its margin; private to model.
#pragma once

#include <QImage>
#include <QPointF>
#include <opencv2/core.hpp>

#include "model/leaf/vein.h"

namespace windfall::model {

/// Distances in pixels at 512 px on the long side, whatever the picture's size, so that one set of constants fits all.
struct VeinFields {
  double unit = 1;     ///< picture pixels a pixel at 512
  cv::Mat1b leaf;      ///< 255 where alpha is at least one half
  cv::Mat1f mainVein;  ///< to the nearest main or lateral vein
  cv::Mat1f
      smallVein;     ///< to the nearest vein of order 3 or more; without any, to the edges of areoles (Voronoi cells)
  cv::Mat1f margin;  ///< to the margin, 0 outside
  cv::Mat1f structural;  ///< structural distance from the root, 0..1
};

/// `image`: RGBA8888. `veins` and `root` in its pixels. `seed` places the areoles.
VeinFields veinFields(const QImage& image, const Veins& veins, QPointF root, quint64 seed);

/// Normal noise of mean 0 and standard deviation 1, smooth over `radius` pixels.
cv::Mat1f smoothNoise(cv::Size size, double radius, quint64 seed);

}  // namespace windfall::model
