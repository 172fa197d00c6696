#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "model/leaf/vein_ridges_private.h"

namespace windfall::model {

namespace {

/// Strength of ridges, bright (sign 1) or dark (-1), over three scales (Hessian).
void ridges(const cv::Mat1f& lightness, float sign, cv::Mat1f& strength, cv::Mat1f& angle) {
  strength = cv::Mat1f::zeros(lightness.size());
  angle = cv::Mat1f::zeros(lightness.size());
  for (const double sigma : {1.2, 2.0, 3.0}) {
    cv::Mat1f smooth, xx, yy, xy;
    cv::GaussianBlur(lightness, smooth, {}, sigma);
    cv::Sobel(smooth, xx, CV_32F, 2, 0, 3, 0.25);
    cv::Sobel(smooth, yy, CV_32F, 0, 2, 3, 0.25);
    cv::Sobel(smooth, xy, CV_32F, 1, 1, 3, 0.25);
    for (int y = 0; y < strength.rows; ++y) {
      for (int x = 0; x < strength.cols; ++x) {
        const float mean = 0.5f * (xx(y, x) + yy(y, x));
        const float half = std::hypot(0.5f * (xx(y, x) - yy(y, x)), xy(y, x));
        const float across = sign * (sign > 0 ? mean - half : mean + half);  // strongest curvature, negative on a ridge
        const float along = std::abs(sign > 0 ? mean + half : mean - half);
        const float here = static_cast<float>(sigma * sigma) * std::max(0.f, -across - along);
        if (here <= strength(y, x)) continue;
        strength(y, x) = here;
        // The larger eigenvalue's direction; the ridge runs along the other one's.
        const float larger = 0.5f * std::atan2(2 * xy(y, x), xx(y, x) - yy(y, x));
        angle(y, x) = sign > 0 ? larger : larger + 1.5707963f;
      }
    }
  }
}

float quantile(const cv::Mat1f& field, const cv::Mat1b& where, double share) {
  std::vector<float> values;
  for (int y = 0; y < field.rows; ++y) {
    for (int x = 0; x < field.cols; ++x) {
      if (where(y, x)) values.push_back(field(y, x));
    }
  }
  if (values.empty()) return 0;
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

}  // namespace

VeinRidges veinRidges(const cv::Mat3f& lab, const cv::Mat1b& leaf) {
  cv::Mat1f lightness, wide, weight;
  cv::extractChannel(lab, lightness, 0);
  // The ground must not look like a ridge beside the margin: outside, the leaf's own surroundings are continued.
  leaf.convertTo(weight, CV_32F, 1 / 255.0);
  cv::Mat1f masked = lightness.mul(weight);
  cv::GaussianBlur(masked, wide, {}, 8);
  cv::GaussianBlur(weight, weight, {}, 8);
  wide /= cv::max(weight, 1e-3);
  lightness -= wide;
  lightness.setTo(0, ~leaf);
  cv::Mat1f depth;
  cv::distanceTransform(leaf, depth, cv::DIST_L2, 3);
  const cv::Mat1b inner = depth > 4;
  VeinRidges bright, dark;
  ridges(lightness, 1, bright.strength, bright.angle);
  ridges(lightness, -1, dark.strength, dark.angle);
  const float brightTop = quantile(bright.strength, inner, 0.995), darkTop = quantile(dark.strength, inner, 0.995);
  VeinRidges result = brightTop >= 0.8f * darkTop ? bright : dark;
  result.contrast = brightTop >= 0.8f * darkTop ? brightTop : darkTop;
  result.strength /= std::max(1e-4f, result.contrast);
  result.strength.setTo(0, ~inner);
  return result;
}

void dropMarginEdges(VeinRidges& ridges, const cv::Mat1b& leaf) {
  constexpr float kReach = 14, kAlong = 0.9f;  // px; cosine of the angle between ridge and margin
  cv::Mat1f depth, smooth, dx, dy;
  cv::distanceTransform(leaf, depth, cv::DIST_L2, 3);
  cv::GaussianBlur(depth, smooth, {}, 2);
  cv::Sobel(smooth, dx, CV_32F, 1, 0, 3);
  cv::Sobel(smooth, dy, CV_32F, 0, 1, 3);
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      if (depth(y, x) <= 0 || depth(y, x) > kReach || ridges.strength(y, x) <= 0) continue;
      const float slope = std::hypot(dx(y, x), dy(y, x));
      // In the middle of a narrow part there is no one margin: a petiole's vein stays.
      if (slope < 4) continue;
      const float along = std::abs(std::cos(ridges.angle(y, x)) * dy(y, x) - std::sin(ridges.angle(y, x)) * dx(y, x));
      if (along > kAlong * slope) ridges.strength(y, x) = 0;
    }
  }
}

}  // namespace windfall::model
