#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "model/leaf/quality_private.h"

namespace windfall::model {

MeasuredLeaf measureLeaf(const ScoredLeaf& leaf) {
  const LeafStructure& structure = *leaf.structure;
  const int width = structure.distance.size.width(), height = structure.distance.size.height();
  MeasuredLeaf result;
  result.unit = std::max(width, height) / 512.0;
  cv::Mat1b whole(height, width), noVein(height, width);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const size_t i = static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x);
      whole(y, x) = structure.regions.values[i] > 0 ? 255 : 0;
      noVein(y, x) = whole(y, x) && structure.veinDistance.values[i] <= 0 ? 0 : 255;
    }
  }
  const int margin = std::max(1, static_cast<int>(std::lround(2 * result.unit)));
  cv::erode(whole, result.leaf, cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * margin + 1, 2 * margin + 1}),
            {-1, -1}, 1, cv::BORDER_CONSTANT, 0);
  cv::distanceTransform(noVein, result.toVein, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  result.toVein /= result.unit;
  result.lab = cv::Mat3f(height, width, reinterpret_cast<cv::Vec3f*>(const_cast<float*>(leaf.lab.data())));
  result.distance = cv::Mat1f(height, width, const_cast<float*>(structure.distance.values.data()));
  return result;
}

cv::Mat maskedBlur(const cv::Mat& values, const cv::Mat1b& leaf, double sigma) {
  cv::Mat1f weight;
  leaf.convertTo(weight, CV_32F, 1 / 255.0);
  cv::Mat masked = values.clone(), blurred;
  masked.setTo(cv::Scalar::all(0), ~leaf);
  cv::GaussianBlur(masked, blurred, {}, sigma, sigma, cv::BORDER_CONSTANT);
  cv::GaussianBlur(weight, weight, {}, sigma, sigma, cv::BORDER_CONSTANT);
  weight = cv::max(weight, 1e-4f);
  cv::Mat share;
  cv::merge(std::vector<cv::Mat>(static_cast<size_t>(values.channels()), weight), share);
  return blurred / share;
}

}  // namespace windfall::model
