// A plant's mesh at rest as Wavefront OBJ.
#pragma once

#include "model/export/exporter.h"
#include "model/plant/geometry.h"

namespace windfall::model {

/// PATH.obj with all parts, PATH.mtl, and the materials' pictures as PNG. Metres, Y up; no skeleton (OBJ has none).
class ObjExporter : public Exporter {
 public:
  QString id() const override { return QStringLiteral("obj"); }
  QString title() const override;
  QStringList extensions() const override { return {QStringLiteral("obj")}; }
  ExportSubject subject() const override { return ExportSubject::Plant; }
  std::vector<ExportParameter> parameters() const override;
  Status write(const Project& project, AssetId asset, const QString& path, const QJsonObject& values,
               Progress& progress) const override;
};

/// The text of the .obj; groups are parts, `library` is the .mtl's name.
QByteArray objText(const PlantGeometry& geometry, const QString& library);
/// The text of the .mtl; `pictures` are the files of the materials' textures by index, empty where there is none.
QByteArray mtlText(const PlantGeometry& geometry, const QStringList& pictures);

}  // namespace windfall::model
