// Leaf textures as one picture and a description of its places.
#pragma once

#include "model/export/exporter.h"
#include "model/leaf/atlas.h"

namespace windfall::model {

/// The kept variants of one leaf, or of all (asset 0), packed.
Result<Atlas> packKept(const Project& project, AssetId asset, const AtlasSettings& settings, Progress& progress);

/// PATH.png with the kept variants, its maps beside it by the packer, and PATH.json with rectangles, pivots, sizes in
/// metres and meshes. Numbers that are absent are the project's.
class AtlasExporter : public Exporter {
 public:
  QString id() const override { return QStringLiteral("atlas"); }
  QString title() const override;
  QStringList extensions() const override { return {QStringLiteral("png")}; }
  ExportSubject subject() const override { return ExportSubject::Leaves; }
  std::vector<ExportParameter> parameters() const override;
  Status write(const Project& project, AssetId asset, const QString& path, const QJsonObject& values,
               Progress& progress) const override;

 private:
  Result<AtlasSettings> settingsFrom(const AtlasSettings& base, const QJsonObject& values) const;
};

}  // namespace windfall::model
