#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "model/leaf/atlas.h"
#include "model/leaf/image_cv_private.h"
#include "model/leaf/linear_light_private.h"

namespace windfall::model {

namespace {

constexpr float kFaint = 1e-4f;  // weight of a transparent texel's colour, so that spread colours live on

/// Straight colours in linear light, weighted by what is seen of them.
cv::Mat4f weighted(const QImage& image) {
  const cv::Mat4b pixels = rgbaView(image);
  cv::Mat4f linear = toLinear(image.convertToFormat(QImage::Format_RGBX8888).convertToFormat(QImage::Format_RGBA8888));
  for (int y = 0; y < linear.rows; ++y) {
    for (int x = 0; x < linear.cols; ++x) {
      const float alpha = static_cast<float>(pixels(y, x)[3]) / 255, weight = alpha + kFaint;
      cv::Vec4f& p = linear(y, x);
      p = {p[0] * weight, p[1] * weight, p[2] * weight, alpha};
    }
  }
  return linear;
}

cv::Mat4f halved(const cv::Mat4f& image) {
  const cv::Size size(std::max(1, image.cols / 2), std::max(1, image.rows / 2));
  cv::Mat4f result;
  cv::resize(image, result, size, 0, 0, cv::INTER_AREA);
  return result;
}

/// The factor on alpha that lets a share `wanted` of the texels reach one half.
float coverageScale(const cv::Mat4f& image, double wanted) {
  std::vector<float> alphas;
  for (const cv::Vec4f& p : image) alphas.push_back(p[3]);
  const auto pass = static_cast<size_t>(std::lround(wanted * static_cast<double>(alphas.size())));
  if (pass == 0 || pass >= alphas.size()) return 1;
  const auto place = alphas.begin() + static_cast<std::ptrdiff_t>(pass - 1);
  std::nth_element(alphas.begin(), place, alphas.end(), std::greater<>());
  return *place > 1e-3f ? std::clamp(0.5f / *place, 0.5f, 4.f) : 1.f;
}

QImage encoded(const cv::Mat4f& level, float alphaScale) {
  cv::Mat4f straight(level.size());
  for (int y = 0; y < level.rows; ++y) {
    for (int x = 0; x < level.cols; ++x) {
      const cv::Vec4f& p = level(y, x);
      const float scale = 1 / (p[3] + kFaint);
      straight(y, x) = {p[0] * scale, p[1] * scale, p[2] * scale, 1};
    }
  }
  QImage image = fromLinear(straight);
  cv::Mat4b pixels = rgbaView(image);
  for (int y = 0; y < level.rows; ++y) {
    for (int x = 0; x < level.cols; ++x) {
      pixels(y, x)[3] = cv::saturate_cast<uchar>(255 * std::min(1.f, level(y, x)[3] * alphaScale));
    }
  }
  return image;
}

}  // namespace

std::vector<QImage> mipLevels(const QImage& image, int count) {
  std::vector<QImage> levels;
  if (image.isNull()) return levels;
  cv::Mat4f level = weighted(image.convertToFormat(QImage::Format_RGBA8888));
  double covered = 0;
  for (const cv::Vec4f& p : level) covered += p[3] >= 0.5f;
  const double wanted = covered / static_cast<double>(level.total());
  while (static_cast<int>(levels.size()) < count && std::max(level.cols, level.rows) > 1) {
    level = halved(level);
    levels.push_back(encoded(level, coverageScale(level, wanted)));
  }
  return levels;
}

}  // namespace windfall::model
