#include <algorithm>
#include <array>
#include <cmath>

#include "model/leaf/image_cv_private.h"
#include "model/leaf/linear_light_private.h"

namespace windfall::model {

namespace {

float decoded(float s) { return s <= 0.04045f ? s / 12.92f : std::pow((s + 0.055f) / 1.055f, 2.4f); }
float encoded(float l) { return l <= 0.0031308f ? 12.92f * l : 1.055f * std::pow(l, 1 / 2.4f) - 0.055f; }

}  // namespace

cv::Mat4f toLinear(const QImage& rgba) {
  std::array<float, 256> table;
  for (size_t i = 0; i < table.size(); ++i) table[i] = decoded(static_cast<float>(i) / 255);
  const cv::Mat4b bytes = rgbaView(rgba);
  cv::Mat4f linear(bytes.size());
  for (int y = 0; y < bytes.rows; ++y) {
    for (int x = 0; x < bytes.cols; ++x) {
      const cv::Vec4b& p = bytes(y, x);
      const float alpha = static_cast<float>(p[3]) / 255;
      linear(y, x) = {table[p[0]] * alpha, table[p[1]] * alpha, table[p[2]] * alpha, alpha};
    }
  }
  return linear;
}

QImage fromLinear(const cv::Mat4f& linear) {
  // Fine enough that the darkest tones keep their byte.
  constexpr int kSteps = 1 << 14;
  std::vector<uchar> table(kSteps + 1);
  for (int i = 0; i <= kSteps; ++i) table[i] = cv::saturate_cast<uchar>(255 * encoded(static_cast<float>(i) / kSteps));
  const auto byte = [&](float l) { return table[cvRound(std::clamp(l, 0.0f, 1.0f) * kSteps)]; };
  QImage image(linear.cols, linear.rows, QImage::Format_RGBA8888);
  cv::Mat4b bytes = rgbaView(image);
  for (int y = 0; y < bytes.rows; ++y) {
    for (int x = 0; x < bytes.cols; ++x) {
      const cv::Vec4f& p = linear(y, x);
      const float scale = p[3] > 1e-4f ? 1 / p[3] : 0;
      bytes(y, x) = {byte(p[0] * scale), byte(p[1] * scale), byte(p[2] * scale), cv::saturate_cast<uchar>(255 * p[3])};
    }
  }
  return image;
}

}  // namespace windfall::model
