#include "model/export/atlas_exporter.h"

#include <QBuffer>
#include <QCoreApplication>
#include <QFileInfo>
#include <QJsonDocument>

#include "model/document/durable_file.h"
#include "model/export/kept_textures.h"
#include "model/progress_part.h"

namespace windfall::model {

QString AtlasExporter::title() const { return QCoreApplication::translate("Exporter", "Leaf atlas (PNG and JSON)"); }

std::vector<ExportParameter> AtlasExporter::parameters() const {
  return {{QStringLiteral("size"), QCoreApplication::translate("Exporter", "Size (px)"), 2048, 64, 8192, true},
          {QStringLiteral("padding"), QCoreApplication::translate("Exporter", "Padding (px)"), 16, 0, 256, true}};
}

Status AtlasExporter::write(const Project& project, AssetId asset, const QString& path, const QJsonObject& values,
                            Progress& progress) const {
  const Result<double> size = parameterValue(*this, values, QStringLiteral("size"));
  if (!size) return size.error();
  const Result<double> padding = parameterValue(*this, values, QStringLiteral("padding"));
  if (!padding) return padding.error();
  if (asset && !project.leaf(asset)) return Error{"there is no such leaf"};

  std::vector<LeafTexture> textures;
  const double count = static_cast<double>(project.leaves.size());
  for (size_t i = 0; i < project.leaves.size(); ++i) {
    const Leaf& leaf = project.leaves[i];
    if (asset && leaf.id != asset) continue;
    ProgressPart part(progress, 0.7 * double(i) / count, 0.7 * double(i + 1) / count);
    Result<std::vector<LeafTexture>> kept = keptTextures(leaf, part);
    if (!kept) return Error{"leaf “" + leaf.name.toStdString() + "”: " + kept.error().message, kept.error().cancelled};
    for (LeafTexture& texture : *kept) textures.push_back(std::move(texture));
  }
  if (textures.empty()) return Error{"no variant is kept: make some textures first"};
  const Result<Atlas> atlas = packAtlas(std::move(textures), {static_cast<int>(*size), static_cast<int>(*padding)});
  if (!atlas) return atlas.error();
  progress.report(0.8);

  QByteArray png;
  QBuffer buffer(&png);
  if (!buffer.open(QIODevice::WriteOnly) || !atlas->image.save(&buffer, "png")) return Error{"the PNG cannot be made"};
  QJsonObject description = describe(*atlas);
  description[QStringLiteral("image")] = QFileInfo(path).fileName();
  if (progress.cancelled()) return Error{"cancelled", true};
  const QFileInfo target(path);
  const QString beside = target.path() + '/' + target.completeBaseName() + QStringLiteral(".json");
  if (Status written = writeDurably(path, png); !written) return written;
  if (const Status written = writeDurably(beside, QJsonDocument(description).toJson()); !written) {
    return Error{QFileInfo(beside).fileName().toStdString() + ": " + written.error().message};
  }
  progress.report(1);
  return ok();
}

}  // namespace windfall::model
