#include "model/leaf/maps.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "model/leaf/ageing_fields_private.h"
#include "model/leaf/image_cv_private.h"
#include "model/leaf/vein_fields_private.h"

namespace windfall::model {

namespace {

/// exp(-d^2 / 2 sigma^2) of every pixel.
cv::Mat1f bell(const cv::Mat1f& distance, double sigma) {
  cv::Mat1f result = distance.mul(distance) * (-0.5 / (sigma * sigma));
  cv::exp(result, result);
  return result;
}

cv::Mat1f fading(const cv::Mat1f& distance, double length) {
  cv::Mat1f result = distance * (-1 / length);
  cv::exp(result, result);
  return result;
}

cv::Mat1b bytes(const cv::Mat1f& values) {
  cv::Mat1b result;
  values.convertTo(result, CV_8U, 255);
  return result;
}

/// Fine light and dark of the picture, -1..1: lightness without what is broader than a vein's width, which is shading.
cv::Mat1f fineLightness(const QImage& image, double unit) {
  cv::Mat1f light, broad;
  cv::extractChannel(toLab(image), light, 0);
  cv::GaussianBlur(light, broad, {}, 4 * unit);
  light = (light - broad) / 15;
  cv::min(light, 1.0, light);
  cv::max(light, -1.0, light);
  return light;
}

/// Height in pixels at 512 px. The note's relief is that of the lower face, where veins stand out; one height serves
/// both faces, so the upper one is its reverse.
cv::Mat1f heightOf(const MapSource& source, const VeinFields& fields, const MapParameters& parameters) {
  const cv::Mat1f lower = 1.0 * bell(fields.mainVein, 2.2) + 0.54 * (1 - fading(fields.mainVein, 9)) +
                          0.18 * bell(fields.smallVein, 1.0) +
                          0.06 * smoothNoise(fields.leaf.size(), 1.2 * fields.unit, source.seed);
  cv::Mat1f height = parameters.detail * 0.3 * fineLightness(source.image, fields.unit) - lower;
  // The distance's pixel steps are no relief.
  cv::GaussianBlur(height, height, {}, 0.5 * std::max(1.0, fields.unit));
  return height;
}

QImage heightImage(const cv::Mat1f& height, const cv::Mat1b& leaf) {
  double low = 0, high = 1;
  if (cv::countNonZero(leaf) > 0) cv::minMaxLoc(height, &low, &high, nullptr, nullptr, leaf);
  const double span = std::max(1e-6, high - low);
  QImage image(height.cols, height.rows, QImage::Format_Grayscale16);
  for (int y = 0; y < height.rows; ++y) {
    auto* row = reinterpret_cast<quint16*>(image.scanLine(y));
    for (int x = 0; x < height.cols; ++x) row[x] = cv::saturate_cast<quint16>(65535 * (height(y, x) - low) / span);
  }
  return image;
}

QImage normalImage(const cv::Mat1f& height, const VeinFields& fields, const cv::Mat4b& pixels, double relief,
                   LeafMaps& maps) {
  cv::Mat1f dx, dy;
  cv::Sobel(height, dx, CV_32F, 1, 0, 3, 1 / 8.0);
  cv::Sobel(height, dy, CV_32F, 0, 1, 3, 1 / 8.0);
  const double strength = kNormalStrength * fields.unit * relief;
  cv::Mat4b normal(height.size());
  std::vector<float> tilts;
  for (int y = 0; y < height.rows; ++y) {
    for (int x = 0; x < height.cols; ++x) {
      const bool inside = fields.leaf(y, x) != 0;
      // Rows count downwards, +Y of the map points up.
      const double nx = inside ? -strength * dx(y, x) : 0, ny = inside ? strength * dy(y, x) : 0;
      const double length = std::sqrt(nx * nx + ny * ny + 1);
      const auto channel = [](double v) { return cv::saturate_cast<uchar>(127.5 + 127.5 * v); };
      normal(y, x) = {channel(nx / length), channel(ny / length), channel(1 / length), pixels(y, x)[3]};
      if (fields.margin(y, x) > 3) {
        tilts.push_back(static_cast<float>(std::atan(std::hypot(nx, ny)) * 180 / std::numbers::pi));
      }
    }
  }
  if (!tilts.empty()) {
    double sum = 0;
    for (const float tilt : tilts) sum += tilt;
    maps.meanTilt = sum / static_cast<double>(tilts.size());
    const auto place = tilts.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(tilts.size() - 1));
    std::nth_element(tilts.begin(), place, tilts.end());
    maps.steepTilt = *place;
  }
  return toRgba(normal);
}

/// Where a place lies deeper than its surroundings, at three widths.
cv::Mat1f occlusionOf(const cv::Mat1f& height, double unit) {
  cv::Mat1f open(height.size(), 1.0f);
  for (const double radius : {2.0, 5.0, 11.0}) {
    cv::Mat1f around;
    cv::GaussianBlur(height, around, {}, radius * unit);
    cv::Mat1f depth = around - height;
    cv::max(depth, 0.0, depth);
    open -= depth * 0.32;
  }
  cv::max(open, 0.0, open);
  return open;
}

QImage translucencyImage(const VeinFields& fields, const cv::Mat4b& pixels, double thickness, QImage& thinness) {
  const cv::Mat1f depth = thickness * (0.5 + 0.9 * bell(fields.mainVein, 2.5) + 0.25 * bell(fields.smallVein, 1.2));
  cv::Mat1f bare = 0.5 * thickness - depth;
  cv::exp(bare, bare);
  thinness = toGray(bytes(bare));
  cv::Mat4b image(pixels.size());
  for (int y = 0; y < pixels.rows; ++y) {
    for (int x = 0; x < pixels.cols; ++x) {
      // Encoded, so that the factor on linear light becomes its root.
      const double through = std::pow(std::exp(-depth(y, x)), 1 / 2.2);
      const cv::Vec4b& p = pixels(y, x);
      image(y, x) = {cv::saturate_cast<uchar>(p[0] * through), cv::saturate_cast<uchar>(p[1] * through),
                     cv::saturate_cast<uchar>(p[2] * through), p[3]};
    }
  }
  return toRgba(image);
}

}  // namespace

LeafMaps makeMaps(const MapSource& given, const MapParameters& parameters) {
  LeafMaps maps;
  if (given.image.isNull()) return maps;
  MapSource source = given;
  source.image = given.image.convertToFormat(QImage::Format_RGBA8888);
  const cv::Mat4b pixels = rgbaView(source.image);
  const VeinFields fields = veinFields(source.image, source.veins, source.root, source.seed);
  const cv::Mat1f height = heightOf(source, fields, parameters);
  maps.height = heightImage(height, fields.leaf);
  maps.normal = normalImage(height, fields, pixels, parameters.relief, maps);
  cv::Mat1f rough = 0.55 - 0.15 * parameters.gloss + 0.15 * bell(fields.mainVein, 2.2) + 0.3 * source.dryness;
  maps.roughness = toGray(bytes(rough));
  maps.translucency = translucencyImage(fields, pixels, parameters.thickness, maps.thinness);
  maps.occlusion = toGray(bytes(occlusionOf(height, fields.unit)));
  maps.ageing = ageingImage(fields, source.seed);
  return maps;
}

}  // namespace windfall::model
