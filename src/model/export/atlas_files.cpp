#include "model/export/atlas_files.h"

#include <QBuffer>
#include <QJsonDocument>
#include <algorithm>

namespace windfall::model {

namespace {

/// Quick and hardly larger than the strongest compression.
constexpr int kPngQuality = 70;
constexpr int kMostMips = 14;

Result<QByteArray> png(const QImage& image, const QString& name) {
  QByteArray bytes;
  QBuffer buffer(&bytes);
  if (!buffer.open(QIODevice::WriteOnly) || !image.save(&buffer, "PNG", kPngQuality)) {
    return Error{name.toStdString() + ": the PNG cannot be made"};
  }
  return bytes;
}

QImage greenTurned(const QImage& normal) {
  QImage image = normal.convertToFormat(QImage::Format_RGBA8888);
  for (int y = 0; y < image.height(); ++y) {
    uchar* row = image.scanLine(y);
    for (int x = 0; x < image.width(); ++x) row[4 * x + 1] = static_cast<uchar>(255 - row[4 * x + 1]);
  }
  return image;
}

QImage smoothnessOf(QImage roughness) {
  roughness.invertPixels();
  return roughness;
}

struct NamedImage {
  QString role, ending;
  QImage image;
};

std::vector<NamedImage> imagesOf(const Atlas& atlas, AtlasPacker packer) {
  const LeafMaps& maps = atlas.maps;
  std::vector<NamedImage> images{{"baseColor", "", atlas.image}};
  if (maps.normal.isNull()) return images;
  switch (packer) {
    case AtlasPacker::Plain:
      images.push_back({"normal", "_normal", maps.normal});
      images.push_back({"height", "_height", maps.height});
      images.push_back({"roughness", "_roughness", maps.roughness});
      images.push_back({"translucency", "_translucency", maps.translucency});
      images.push_back({"occlusion", "_occlusion", maps.occlusion});
      break;
    case AtlasPacker::Gltf:
      images.push_back({"normal", "_normal", maps.normal});
      images.push_back({"occlusionRoughnessMetallic", "_orm",
                        packedChannels({&maps.occlusion, &maps.roughness, nullptr, nullptr}, {255, 140, 0, 255})});
      images.push_back({"diffuseTransmissionColor", "_transmission", maps.translucency});
      break;
    case AtlasPacker::Unity: {
      const QImage smooth = smoothnessOf(maps.roughness);
      images.push_back({"normal", "_normal", maps.normal});
      images.push_back({"metallicOcclusionDetailSmoothness", "_mask",
                        packedChannels({nullptr, &maps.occlusion, nullptr, &smooth}, {0, 255, 0, 115})});
      images.push_back({"translucency", "_translucency", maps.translucency});
      break;
    }
    case AtlasPacker::Unreal:
      images.push_back({"normal", "_normal", greenTurned(maps.normal)});
      images.push_back({"occlusionRoughnessMetallic", "_orm",
                        packedChannels({&maps.occlusion, &maps.roughness, nullptr, nullptr}, {255, 140, 0, 255})});
      images.push_back({"subsurfaceColor", "_subsurface", maps.translucency});
      break;
  }
  return images;
}

}  // namespace

QImage packedChannels(const std::array<const QImage*, 4>& channels, const std::array<int, 4>& missing) {
  QSize size;
  for (const QImage* channel : channels) {
    if (channel != nullptr) size = channel->size();
  }
  QImage image(size, QImage::Format_RGBA8888);
  for (int y = 0; y < size.height(); ++y) {
    uchar* row = image.scanLine(y);
    for (size_t c = 0; c < 4; ++c) {
      const uchar* from = channels[c] != nullptr ? channels[c]->constScanLine(y) : nullptr;
      for (int x = 0; x < size.width(); ++x) {
        row[4 * static_cast<size_t>(x) + c] = from != nullptr ? from[x] : static_cast<uchar>(missing[c]);
      }
    }
  }
  return image;
}

Result<std::vector<NamedBytes>> atlasFiles(const Atlas& atlas, const AtlasSettings& settings, const QString& stem,
                                           bool mipFiles) {
  std::vector<NamedBytes> files;
  QJsonObject maps;
  for (const NamedImage& image : imagesOf(atlas, settings.packer)) {
    const QString name = stem + image.ending + QStringLiteral(".png");
    Result<QByteArray> bytes = png(image.image, name);
    if (!bytes) return bytes.error();
    files.push_back({name, std::move(*bytes)});
    maps[image.role] = name;
  }
  QJsonObject description = describe(atlas);
  description[QStringLiteral("image")] = stem + QStringLiteral(".png");
  description[QStringLiteral("packer")] = nameOf(settings.packer);
  description[QStringLiteral("maps")] = maps;
  description[QStringLiteral("normalY")] = settings.packer == AtlasPacker::Unreal ? "down" : "up";
  AtlasSettings used = settings;
  used.size = std::max(atlas.image.width(), atlas.image.height());
  description[QStringLiteral("gap")] = used.gap();
  if (mipFiles) {
    int level = 0;
    for (const QImage& image : mipLevels(atlas.image, std::max(1, settings.mipLevels))) {
      const QString name = QStringLiteral("%1_mip%2.png").arg(stem).arg(++level);
      Result<QByteArray> bytes = png(image, name);
      if (!bytes) return bytes.error();
      files.push_back({name, std::move(*bytes)});
    }
    description[QStringLiteral("mipLevels")] = level;
  }
  files.push_back({stem + QStringLiteral(".json"), QJsonDocument(description).toJson()});
  return files;
}

QStringList staleAtlasFiles(const QString& stem, const std::vector<NamedBytes>& files) {
  QStringList names;
  for (const char* ending : {"_normal", "_height", "_roughness", "_translucency", "_occlusion", "_orm", "_transmission",
                             "_mask", "_subsurface"}) {
    names << stem + QLatin1String(ending) + QStringLiteral(".png");
  }
  for (int level = 1; level <= kMostMips; ++level) names << QStringLiteral("%1_mip%2.png").arg(stem).arg(level);
  for (const NamedBytes& file : files) names.removeAll(file.name);
  return names;
}

}  // namespace windfall::model
