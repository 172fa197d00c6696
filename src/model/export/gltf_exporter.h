// A plant as glTF 2.0: skinned mesh, materials, leaves, motions.
#pragma once

#include "model/export/exporter.h"
#include "model/export/plant_model.h"

namespace windfall::model {

/// .glb in one file, .gltf with a .bin beside it. Joints are named like the bones and turned like the world, so that a
/// clip's rotations are written as they are.
class GltfExporter : public Exporter {
 public:
  QString id() const override { return QStringLiteral("gltf"); }
  QString title() const override;
  QStringList extensions() const override { return {QStringLiteral("glb"), QStringLiteral("gltf")}; }
  ExportSubject subject() const override { return ExportSubject::Plant; }
  std::vector<ExportParameter> parameters() const override;
  Status write(const Project& project, AssetId asset, const QString& path, const QJsonObject& values,
               Progress& progress) const override;
};

/// The parameters that all plant exporters share, and what they say.
std::vector<ExportParameter> plantExportParameters();
Result<PlantExportOptions> plantExportOptions(const Exporter& exporter, const QJsonObject& values);

/// The file's bytes; with a name for the buffer a .gltf, whose buffer goes into `buffer`.
QByteArray gltfOf(const PlantModel& model, LeafExport leaves, const QString& bufferName = {},
                  QByteArray* buffer = nullptr);

}  // namespace windfall::model
