#include "ximgproc.h"

#if defined(WINDFALL_HAS_XIMGPROC)

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <opencv2/ximgproc/slic.hpp>

windfall::model::SlicPeer openCvSlic() {
  return {"OpenCV's SLIC", [](const windfall::model::ScalarField& distance, int count) {
            const cv::Mat1f field(distance.size.height(), distance.size.width(),
                                  const_cast<float*>(distance.values.data()));
            cv::Mat1b grey;
            field.convertTo(grey, CV_8U, 255);
            // It knows no mask: superpixels are spent on the ground too. Ten rounds are its default.
            const double side = std::sqrt(static_cast<double>(grey.total()) / count);
            const auto slic = cv::ximgproc::createSuperpixelSLIC(grey, cv::ximgproc::SLIC,
                                                                 std::max(2, static_cast<int>(std::lround(side))));
            slic->iterate(10);
            cv::Mat1i labels;
            slic->getLabels(labels);
          }};
}

#else

windfall::model::SlicPeer openCvSlic() { return {"OpenCV's SLIC, ximgproc was not found", {}}; }

#endif
