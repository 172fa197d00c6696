#include "model/leaf/atlas.h"

#include <QJsonArray>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "model/leaf/dilate.h"
#include "model/leaf/image_cv_private.h"
#include "model/leaf/linear_light_private.h"
#include "model/leaf/rect_packing.h"

namespace windfall::model {

namespace {

constexpr int kLeastSide = 64, kMostSide = 16384;
constexpr int kLeastTexture = 4;  // px: smaller leaves cannot be told apart

QSize scaledSize(const QImage& image, double scale) {
  return {std::max(1, static_cast<int>(std::floor(image.width() * scale))),
          std::max(1, static_cast<int>(std::floor(image.height() * scale)))};
}

std::optional<std::vector<QPoint>> placesAt(const std::vector<LeafTexture>& textures, double scale,
                                            const AtlasSettings& settings) {
  std::vector<QSize> sizes;
  for (const LeafTexture& texture : textures) {
    sizes.push_back(scaledSize(texture.image, scale) + QSize(settings.padding, settings.padding));
  }
  return packRectangles(sizes, settings.size);
}

QImage shrunk(const QImage& image, QSize size) {
  if (image.size() == size) return image;
  cv::Mat4f small;
  cv::resize(toLinear(image), small, {size.width(), size.height()}, 0, 0, cv::INTER_AREA);
  return fromLinear(small);
}

}  // namespace

Result<Atlas> packAtlas(std::vector<LeafTexture> textures, const AtlasSettings& settings) {
  const int side = settings.size;
  if (side < kLeastSide || side > kMostSide || (side & (side - 1)) != 0) {
    return Error{"the atlas's size must be a power of two from 64 to 16384"};
  }
  if (settings.padding < 0 || settings.padding > side / 8) {
    return Error{"the atlas's padding must be from 0 to an eighth of its size"};
  }
  if (textures.empty()) return Error{"no textures to pack"};
  for (LeafTexture& texture : textures) {
    if (texture.image.isNull()) return Error{texture.name.toStdString() + ": the texture is empty"};
    texture.image = texture.image.convertToFormat(QImage::Format_RGBA8888);
  }

  // The largest common scale at which all fit, by bisection; packing is not monotone, so the best seen is kept.
  double scale = 1;
  std::optional<std::vector<QPoint>> corners = placesAt(textures, scale, settings);
  if (!corners) {
    double low = 0, high = 1;
    for (int i = 0; i < 14; ++i) {
      const double middle = (low + high) / 2;
      if (auto found = placesAt(textures, middle, settings)) {
        low = scale = middle;
        corners = std::move(found);
      } else {
        high = middle;
      }
    }
  }
  const auto tooSmall = [&](const LeafTexture& texture) {
    const QSize size = scaledSize(texture.image, scale);
    return std::max(size.width(), size.height()) <
           std::min(kLeastTexture, std::max(texture.image.width(), texture.image.height()));
  };
  if (!corners || std::any_of(textures.begin(), textures.end(), tooSmall)) {
    return Error{std::to_string(textures.size()) + " textures do not fit into an atlas of " + std::to_string(side) +
                 " px; make it larger or its padding smaller"};
  }

  Atlas atlas;
  atlas.image = QImage(side, side, QImage::Format_RGBA8888);
  atlas.image.fill(Qt::transparent);
  const QPoint inset(settings.padding / 2, settings.padding / 2);
  for (size_t i = 0; i < textures.size(); ++i) {
    const QRect place(corners->at(i) + inset, scaledSize(textures[i].image, scale));
    const QImage small = shrunk(textures[i].image, place.size());
    rgbaView(small).copyTo(rgbaView(atlas.image)(cv::Rect(place.x(), place.y(), place.width(), place.height())));
    atlas.places.push_back(place);
  }
  // Once over the whole: half of each gap belongs to the leaf that is nearer.
  atlas.image = spreadColours(atlas.image);
  atlas.textures = std::move(textures);
  return atlas;
}

QJsonObject describe(const Atlas& atlas) {
  const double width = std::max(1, atlas.image.width()), height = std::max(1, atlas.image.height());
  QJsonArray leaves;
  for (size_t i = 0; i < atlas.places.size(); ++i) {
    const QRect& r = atlas.places[i];
    const LeafTexture& texture = atlas.textures[i];
    leaves.append(QJsonObject{
        {"name", texture.name},
        {"rectangle", QJsonArray{r.x(), r.y(), r.width(), r.height()}},
        {"uv", QJsonArray{r.x() / width, r.y() / height, (r.x() + r.width()) / width, (r.y() + r.height()) / height}},
        {"pivot", QJsonArray{texture.pivot.x(), texture.pivot.y()}},
        {"metres", QJsonArray{texture.metres.width(), texture.metres.height()}},
    });
  }
  return {{"size", QJsonArray{atlas.image.width(), atlas.image.height()}}, {"origin", "top left"}, {"leaves", leaves}};
}

}  // namespace windfall::model
