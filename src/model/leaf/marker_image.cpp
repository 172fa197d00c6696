#include "model/leaf/marker_image.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "model/leaf/image_cv_private.h"
#include "model/leaf/region_match.h"

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

Status checkMarkers(const LeafStages& stages) {
  if (stages.made.markers.empty()) return ok();
  const LabelField& regions = stages.grown.regions;
  const bool any = std::any_of(stages.made.markers.begin(), stages.made.markers.end(),
                               [&](const QPointF& marker) { return regionAt(stages, regions, marker) > 0; });
  if (!any) return Error{"no marker lies on the leaf"};
  qint32 first = 0;
  for (const qint32 region : regions.values) {
    if (region <= 0 || region == regions.petiole || region == first) continue;
    if (first > 0) return ok();
    first = region;
  }
  return Error{"the markers lie all in one place: the leaf is one region"};
}

}  // namespace windfall::model
