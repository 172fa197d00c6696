#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "model/leaf/ageing_fields_private.h"
#include "model/leaf/image_cv_private.h"

namespace windfall::model {

QImage ageingImage(const VeinFields& fields, quint64 seed) {
  const cv::Size size = fields.leaf.size();
  const cv::Mat1f blotches = smoothNoise(size, 16 * fields.unit, seed ^ 0xa9e1u),
                  patches = smoothNoise(size, 34 * fields.unit, seed ^ 0x5ea5u),
                  grain = smoothNoise(size, 3.5 * fields.unit, seed ^ 0x91aau);
  double deepest = 1;
  cv::minMaxLoc(fields.margin, nullptr, &deepest, nullptr, nullptr, fields.leaf);
  cv::Mat4b image(size);
  const auto byte = [](float v) { return cv::saturate_cast<uchar>(255 * v); };
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const float d = fields.mainVein(y, x), small = fields.smallVein(y, x);
      const float vein = std::exp(-d / 7), narrow = std::exp(-small * small / 4);
      const float inner = std::sqrt(std::min(1.f, fields.margin(y, x) / static_cast<float>(deepest)));
      const float green = 0.20f + 0.22f * (1 - fields.structural(y, x)) + 0.40f * vein + 0.05f * narrow +
                          0.07f * blotches(y, x) + 0.05f * patches(y, x) + 0.02f * grain(y, x) + 0.10f * inner;
      const float brown =
          0.06f + 0.72f * inner + 0.10f * vein + 0.10f * blotches(y, x) + 0.05f * patches(y, x) + 0.03f * grain(y, x);
      const float red = 0.62f + 0.20f * patches(y, x) + 0.10f * blotches(y, x) - 0.22f * vein + 0.05f * grain(y, x);
      image(y, x) = {byte(green), byte(brown), byte(red), 255};
    }
  }
  return toRgba(image);
}

}  // namespace windfall::model
