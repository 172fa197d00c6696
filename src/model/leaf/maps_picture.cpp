#include "model/leaf/maps_picture.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "model/leaf/image_cv_private.h"
#include "model/leaf/linear_light_private.h"

namespace windfall::model {

namespace {

QImage withAlpha(const QImage& map, const QImage& texture) {
  QImage image = map.convertToFormat(QImage::Format_RGBA8888);
  for (int y = 0; y < image.height(); ++y) {
    const uchar* from = texture.constScanLine(y);
    uchar* to = image.scanLine(y);
    for (int x = 0; x < image.width(); ++x) to[4 * x + 3] = from[4 * x + 3];
  }
  return image;
}

/// Blinn and Phong are enough to judge a relief by.
QImage lit(const QImage& texture, const LeafMaps& maps) {
  const cv::Vec3f light = cv::normalize(cv::Vec3f(-0.55f, 0.6f, 0.6f)),
                  middle = cv::normalize(light + cv::Vec3f(0, 0, 1));
  cv::Mat4f linear = toLinear(texture);
  for (int y = 0; y < linear.rows; ++y) {
    const uchar *normal = maps.normal.constScanLine(y), *rough = maps.roughness.constScanLine(y),
                *open = maps.occlusion.constScanLine(y);
    for (int x = 0; x < linear.cols; ++x) {
      const cv::Vec3f n(normal[4 * x] / 127.5f - 1, normal[4 * x + 1] / 127.5f - 1, normal[4 * x + 2] / 127.5f - 1);
      const float facing = std::max(0.f, n.dot(light)), roughness = static_cast<float>(rough[x]) / 255;
      const float power = 2 / std::max(0.02f, std::pow(roughness, 4.f));
      const float shine = 0.10f * (1 - roughness) * std::pow(std::max(0.f, n.dot(middle)), power);
      const float diffuse = 0.35f * static_cast<float>(open[x]) / 255 + 1.15f * facing;
      cv::Vec4f& p = linear(y, x);
      for (int c = 0; c < 3; ++c) p[c] = std::min(p[3], p[c] * diffuse + shine * p[3]);
    }
  }
  return fromLinear(linear);
}

}  // namespace

QImage mapPicture(const QImage& texture, const LeafMaps& maps, MapKind kind) {
  const QImage source = texture.convertToFormat(QImage::Format_RGBA8888);
  if (kind == MapKind::Colour || maps.normal.size() != source.size()) return source;
  switch (kind) {
    case MapKind::Lit:
      return lit(source, maps);
    case MapKind::Normal:
      return maps.normal;
    case MapKind::Height:
      return withAlpha(maps.height, source);
    case MapKind::Roughness:
      return withAlpha(maps.roughness, source);
    case MapKind::Translucency:
      return maps.translucency;
    case MapKind::Occlusion:
      return withAlpha(maps.occlusion, source);
    case MapKind::Colour:
      break;
  }
  return source;
}

}  // namespace windfall::model
