#include "model/leaf/soft_mask.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "model/leaf/image_cv_private.h"

namespace windfall::model {

namespace {

constexpr double kEnlarged = 1.3;  ///< from where on the mask's pixels would be seen as steps
constexpr int kReach = 3;          // px: how wide the filter is, and how far beside the margin it may act
/// Variances of a window, from ground 0 to leaf 1: of noise alone, and where an edge is trusted half.
constexpr float kEven = 2e-3f, kEdge = 0.03f;

cv::Mat kernel(int reach) { return cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * reach + 1, 2 * reach + 1}); }

/// 0 ground, 1 leaf, by the photo alone: its alpha, or where colours lie between the means of both sides of the margin.
/// Empty: they look alike.
cv::Mat1f sideOf(const cv::Mat1b& mask, const QImage& photo) {
  const cv::Mat4b pixels = rgbaView(photo);
  cv::Mat1f side(mask.size());
  cv::Mat1b alpha;
  cv::extractChannel(pixels, alpha, 3);
  double least = 255;
  cv::minMaxLoc(alpha, &least);
  if (least < 128) {
    alpha.convertTo(side, CV_32F, 1 / 255.0);
    return side;
  }
  cv::Mat1b nearer, wider, inner, outer;
  cv::erode(mask, nearer, kernel(1));
  cv::erode(mask, inner, kernel(3 * kReach));
  cv::dilate(mask, wider, kernel(1));
  cv::dilate(mask, outer, kernel(3 * kReach));
  const cv::Mat3f lab = toLab(photo);
  const cv::Scalar leaf = cv::mean(lab, nearer & ~inner), ground = cv::mean(lab, outer & ~wider);
  cv::Vec3f axis, from;
  for (int c = 0; c < 3; ++c) {
    axis[c] = static_cast<float>(leaf[c] - ground[c]);
    from[c] = static_cast<float>(ground[c]);
  }
  const float length = axis.dot(axis);
  if (length < 100) return {};
  for (int y = 0; y < side.rows; ++y) {
    for (int x = 0; x < side.cols; ++x) side(y, x) = (lab(y, x) - from).dot(axis) / length;
  }
  return side;
}

/// The mask as a linear function of `side` in each window, near its margin.
cv::Mat1f filtered(const cv::Mat1f& mask, const cv::Mat1b& binary, const cv::Mat1f& side) {
  const cv::Size window(2 * kReach + 1, 2 * kReach + 1);
  const auto mean = [&](const cv::Mat1f& of) {
    cv::Mat1f result;
    cv::boxFilter(of, result, -1, window);
    return result;
  };
  const cv::Mat1f meanSide = mean(side), meanMask = mean(mask);
  const cv::Mat1f variance = mean(side.mul(side)) - meanSide.mul(meanSide);
  const cv::Mat1f slope = (mean(side.mul(mask)) - meanSide.mul(meanMask)) / (variance + kEven);
  const cv::Mat1f offset = meanMask - slope.mul(meanSide);
  cv::Mat1f result = mean(slope).mul(side) + mean(offset);
  // Where the artist cut through the leaf, or the ground looks like it, the mask alone knows.
  const cv::Mat1f trust = variance / (variance + kEdge);
  result = trust.mul(result) + (1 - trust).mul(mask);
  cv::Mat1b inner, outer;
  cv::erode(binary, inner, kernel(kReach));
  cv::dilate(binary, outer, kernel(kReach));
  result.setTo(1, inner);
  result.setTo(0, ~outer);
  return cv::min(cv::max(result, 0), 1);
}

}  // namespace

QImage softMask(const QImage& mask, const QImage& photo, QSize size) {
  const cv::Mat1b given = grayView(mask);
  cv::Mat1f field;
  given.convertTo(field, CV_32F, 1 / 255.0);
  const double scale = static_cast<double>(size.width()) / mask.width();
  if (scale > kEnlarged && photo.size() == mask.size()) {
    const cv::Mat1b binary = given > 127;
    if (const cv::Mat1f side = sideOf(binary, photo); !side.empty()) field = filtered(field, binary, side);
  }
  if (scale > 1) cv::GaussianBlur(field, field, {}, scale > kEnlarged ? 0.9 : 0.6);
  cv::resize(field, field, {size.width(), size.height()}, 0, 0, scale > 1 ? cv::INTER_CUBIC : cv::INTER_AREA);
  const double sharpness = std::max(1.0, 0.6 * scale);
  cv::Mat1b alpha;
  field.convertTo(alpha, CV_8U, 255 * sharpness, 127.5 * (1 - sharpness));
  return toGray(alpha);
}

}  // namespace windfall::model
