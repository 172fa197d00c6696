#include "model/leaf/atlas.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "model/leaf/atlas_layout_private.h"
#include "model/leaf/dilate.h"
#include "model/leaf/image_cv_private.h"
#include "model/leaf/linear_light_private.h"

namespace windfall::model {

namespace {

constexpr int kLeastSide = 64, kMostSide = 16384;
constexpr int kLeastTexture = 4;  // px: smaller leaves cannot be told apart

QImage turnedIf(const QImage& image, bool turned) {
  return turned ? image.transformed(QTransform().rotate(90)) : image;
}

/// Colours, by linear light.
QImage shrunkColours(const QImage& image, QSize size) {
  if (image.size() == size) return image;
  cv::Mat4f small;
  cv::resize(toLinear(image), small, {size.width(), size.height()}, 0, 0, cv::INTER_AREA);
  return fromLinear(small);
}

/// Numbers, as they are.
QImage shrunkNumbers(const QImage& image, QSize size, int type) {
  if (image.size() == size) return image;
  const cv::Mat from(image.height(), image.width(), type, const_cast<uchar*>(image.constBits()),
                     static_cast<size_t>(image.bytesPerLine()));
  QImage result(size, image.format());
  cv::Mat to(size.height(), size.width(), type, result.bits(), static_cast<size_t>(result.bytesPerLine()));
  cv::resize(from, to, to.size(), 0, 0, cv::INTER_AREA);
  return result;
}

/// Unit vectors again after shrinking; a picture turned clockwise turns its vectors with it.
QImage placedNormals(const QImage& image, QSize size, bool turned) {
  QImage result = shrunkNumbers(image, turned ? size.transposed() : size, CV_8UC4);
  result = turnedIf(result, turned);
  cv::Mat4b pixels = rgbaView(result);
  for (int y = 0; y < pixels.rows; ++y) {
    for (int x = 0; x < pixels.cols; ++x) {
      cv::Vec4b& p = pixels(y, x);
      cv::Vec3f n(p[0] / 127.5f - 1, p[1] / 127.5f - 1, p[2] / 127.5f - 1);
      if (turned) n = {n[1], -n[0], n[2]};
      n *= 1 / std::max(1e-3, cv::norm(n));
      for (int c = 0; c < 3; ++c) p[c] = cv::saturate_cast<uchar>(127.5f + 127.5f * n[c]);
    }
  }
  return result;
}

void paste(const QImage& from, QImage& into, const QRect& place) {
  const int bytes = into.depth() / 8;
  for (int y = 0; y < place.height(); ++y) {
    const uchar* row = from.constScanLine(y);
    std::copy(row, row + static_cast<qsizetype>(place.width()) * bytes,
              into.scanLine(place.y() + y) + static_cast<qsizetype>(place.x()) * bytes);
  }
}

QImage cleared(QSize size, QImage::Format format, const QColor& colour) {
  QImage image(size, format);
  image.fill(colour);
  return image;
}

void clearMaps(Atlas& atlas, QSize size) {
  atlas.maps.height = cleared(size, QImage::Format_Grayscale16, Qt::black);
  atlas.maps.normal = cleared(size, QImage::Format_RGBA8888, QColor(128, 128, 255, 0));
  atlas.maps.roughness = cleared(size, QImage::Format_Grayscale8, QColor(140, 140, 140));
  atlas.maps.translucency = cleared(size, QImage::Format_RGBA8888, QColor(0, 0, 0, 0));
  atlas.maps.occlusion = cleared(size, QImage::Format_Grayscale8, Qt::white);
}

void placeMaps(const LeafMaps& maps, Atlas& atlas, const QRect& place, bool turned) {
  const QSize size = place.size(), upright = turned ? size.transposed() : size;
  const auto placed = [&](const QImage& image) { return turnedIf(image, turned); };
  paste(placed(shrunkNumbers(maps.height, upright, CV_16UC1)), atlas.maps.height, place);
  paste(placedNormals(maps.normal, size, turned), atlas.maps.normal, place);
  paste(placed(shrunkNumbers(maps.roughness, upright, CV_8UC1)), atlas.maps.roughness, place);
  paste(placed(shrunkColours(maps.translucency, upright)), atlas.maps.translucency, place);
  paste(placed(shrunkNumbers(maps.occlusion, upright, CV_8UC1)), atlas.maps.occlusion, place);
}

Status check(const std::vector<LeafTexture>& textures, const AtlasSettings& settings) {
  const int side = settings.size;
  if (side != 0 && (side < kLeastSide || side > kMostSide || (side & (side - 1)) != 0)) {
    return Error{"the atlas's size must be a power of two from 64 to 16384"};
  }
  if (settings.padding < 0 || settings.padding > (side > 0 ? side : kMostSide) / 8) {
    return Error{"the atlas's padding must be from 0 to an eighth of its size"};
  }
  if (textures.empty()) return Error{"no textures to pack"};
  for (const LeafTexture& texture : textures) {
    if (texture.image.isNull()) return Error{texture.name.toStdString() + ": the texture is empty"};
  }
  return ok();
}

}  // namespace

QPointF Atlas::toAtlas(size_t texture, QPointF share) const {
  const QRect& place = places[texture];
  const QPointF at = turned[texture] ? QPointF(1 - share.y(), share.x()) : share;
  return {(place.x() + at.x() * place.width()) / image.width(), (place.y() + at.y() * place.height()) / image.height()};
}

Result<Atlas> packAtlas(std::vector<LeafTexture> textures, const AtlasSettings& settings) {
  if (const Status good = check(textures, settings); !good) return good.error();
  std::vector<QSize> sizes;
  for (LeafTexture& texture : textures) {
    texture.image = texture.image.convertToFormat(QImage::Format_RGBA8888);
    sizes.push_back(texture.image.size());
  }
  const std::optional<AtlasLayout> layout = layOut(sizes, settings);
  const auto tooSmall = [&](size_t i) {
    const QSize place = layout->places[i].size();
    return std::max(place.width(), place.height()) <
           std::min(kLeastTexture, std::max(sizes[i].width(), sizes[i].height()));
  };
  bool fits = layout.has_value();
  for (size_t i = 0; fits && i < sizes.size(); ++i) fits = !tooSmall(i);
  if (!fits) {
    return Error{std::to_string(textures.size()) + " textures do not fit into an atlas" +
                 (settings.size > 0 ? " of " + std::to_string(settings.size) + " px; make it larger or" : "; make") +
                 " its padding smaller"};
  }
  const QSize size = layout->size;

  Atlas atlas;
  atlas.image = cleared(size, QImage::Format_RGBA8888, Qt::transparent);
  atlas.places = layout->places;
  atlas.turned = layout->turned;
  atlas.scale = layout->scale;
  const bool mapped = std::all_of(textures.begin(), textures.end(), [](const LeafTexture& texture) {
    return texture.maps.normal.size() == texture.image.size();
  });
  if (mapped) clearMaps(atlas, size);
  for (size_t i = 0; i < textures.size(); ++i) {
    const QRect& place = atlas.places[i];
    const bool turned = atlas.turned[i];
    const QSize upright = turned ? place.size().transposed() : place.size();
    paste(turnedIf(shrunkColours(textures[i].image, upright), turned), atlas.image, place);
    if (mapped) placeMaps(textures[i].maps, atlas, place, turned);
  }
  // Once over the whole: half of each gap belongs to the leaf that is nearer.
  const std::vector<std::int32_t> nearest = nearestSolid(atlas.image);
  spreadFrom(nearest, atlas.image);
  if (mapped) {
    for (QImage* map : {&atlas.maps.height, &atlas.maps.normal, &atlas.maps.roughness, &atlas.maps.translucency,
                        &atlas.maps.occlusion}) {
      spreadFrom(nearest, *map);
    }
  }
  atlas.textures = std::move(textures);
  return atlas;
}

}  // namespace windfall::model
