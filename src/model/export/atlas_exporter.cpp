#include "model/export/atlas_exporter.h"

#include <QCoreApplication>
#include <QFileInfo>

#include "model/export/atlas_files.h"
#include "model/export/kept_textures.h"
#include "model/progress_part.h"

namespace windfall::model {

QString AtlasExporter::title() const { return QCoreApplication::translate("Exporter", "Leaf atlas (PNG and JSON)"); }

std::vector<ExportParameter> AtlasExporter::parameters() const {
  const AtlasSettings fresh;
  const auto number = [](const char* key, const char* title, double initial, double low, double high) {
    return ExportParameter{
        QString::fromLatin1(key), QCoreApplication::translate("Exporter", title), initial, low, high, true, {}, {}};
  };
  return {
      number("size", QT_TRANSLATE_NOOP("Exporter", "Size (px), 0: automatic"), fresh.size, 0, 16384),
      number("leafPixels", QT_TRANSLATE_NOOP("Exporter", "Largest leaf (px), 0: as made"), fresh.leafPixels, 0, 8192),
      number("padding", QT_TRANSLATE_NOOP("Exporter", "Padding (px)"), fresh.padding, 0, 2048),
      number("mipLevels", QT_TRANSLATE_NOOP("Exporter", "Mip levels kept clean"), fresh.mipLevels, 0, 12),
      number("rotate", QT_TRANSLATE_NOOP("Exporter", "Leaves may lie on their side"), fresh.rotate, 0, 1),
      number("packer", QT_TRANSLATE_NOOP("Exporter", "Packing: plain, glTF, Unity, Unreal"), 0, 0, 3)};
}

Result<AtlasSettings> AtlasExporter::settingsFrom(const AtlasSettings& base, const QJsonObject& values) const {
  AtlasSettings settings = base;
  for (const ExportParameter& parameter : parameters()) {
    if (!values.contains(parameter.key)) continue;
    const Result<double> value = parameterValue(*this, values, parameter.key);
    if (!value) return value.error();
    const int number = static_cast<int>(*value);
    if (parameter.key == QLatin1String("size")) settings.size = number;
    if (parameter.key == QLatin1String("leafPixels")) settings.leafPixels = number;
    if (parameter.key == QLatin1String("padding")) settings.padding = number;
    if (parameter.key == QLatin1String("mipLevels")) settings.mipLevels = number;
    if (parameter.key == QLatin1String("rotate")) settings.rotate = number != 0;
    if (parameter.key == QLatin1String("packer")) settings.packer = static_cast<AtlasPacker>(number);
  }
  return settings;
}

Result<Atlas> packKept(const Project& project, AssetId asset, const AtlasSettings& settings, Progress& progress) {
  std::vector<LeafTexture> textures;
  const double count = static_cast<double>(project.leaves.size());
  for (size_t i = 0; i < project.leaves.size(); ++i) {
    const Leaf& leaf = project.leaves[i];
    if (asset && leaf.id != asset) continue;
    ProgressPart part(progress, 0.8 * double(i) / count, 0.8 * double(i + 1) / count);
    Result<std::vector<LeafTexture>> kept = keptTextures(leaf, part);
    if (!kept) return Error{"leaf “" + leaf.name.toStdString() + "”: " + kept.error().message, kept.error().cancelled};
    for (LeafTexture& texture : *kept) textures.push_back(std::move(texture));
  }
  if (textures.empty()) return Error{"no variant is kept: make some textures first"};
  return packAtlas(std::move(textures), settings);
}

Status AtlasExporter::write(const Project& project, AssetId asset, const QString& path, const QJsonObject& values,
                            Progress& progress) const {
  const Result<AtlasSettings> settings = settingsFrom(project.atlas, values);
  if (!settings) return settings.error();
  if (asset && !project.leaf(asset)) return Error{"there is no such leaf"};
  const Result<Atlas> atlas = packKept(project, asset, *settings, progress);
  if (!atlas) return atlas.error();
  progress.report(0.85);
  const QFileInfo target(path);
  const Result<std::vector<NamedBytes>> files = atlasFiles(*atlas, *settings, target.completeBaseName());
  if (!files) return files.error();
  if (progress.cancelled()) return Error{"cancelled", true};
  if (!QFileInfo(target.path()).isDir()) return Error{"the folder " + target.path().toStdString() + " does not exist"};
  const Status written = writeTogether(target.path(), *files, staleAtlasFiles(target.completeBaseName(), *files));
  if (!written) return written;
  progress.report(1);
  return ok();
}

}  // namespace windfall::model
