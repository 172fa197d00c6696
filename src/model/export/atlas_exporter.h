// Leaf textures as one picture and a description of its places.
#pragma once

#include "model/export/exporter.h"

namespace windfall::model {

/// PATH.png with the kept variants, packed and dilated, and PATH.json with rectangles, pivots and sizes in metres.
class AtlasExporter : public Exporter {
 public:
  QString id() const override { return QStringLiteral("atlas"); }
  QString title() const override;
  QStringList extensions() const override { return {QStringLiteral("png")}; }
  ExportSubject subject() const override { return ExportSubject::Leaves; }
  std::vector<ExportParameter> parameters() const override;
  Status write(const Project& project, AssetId asset, const QString& path, const QJsonObject& values,
               Progress& progress) const override;
};

}  // namespace windfall::model
