// Importers of files that hold skeletons alone: AgroEcoSim's .prim and the thesis's JSON.
#pragma once

#include "model/plant/import.h"
#include "model/plant/skeleton_graph.h"

namespace windfall::model {

class PrimImporter : public PlantImporter {
 public:
  QString name() const override { return QStringLiteral("AgroEcoSim"); }
  QStringList extensions() const override { return {QStringLiteral("prim")}; }
  Result<PlantGeometry> read(const SourceFile& file, const SurfaceSettings& surface, WoodMesh wood,
                             Progress& progress) const override;
};

class JsonSkeletonImporter : public PlantImporter {
 public:
  QString name() const override { return QStringLiteral("Skeleton (JSON)"); }
  QStringList extensions() const override { return {QStringLiteral("json")}; }
  Result<PlantGeometry> read(const SourceFile& file, const SurfaceSettings& surface, WoodMesh wood,
                             Progress& progress) const override;
};

/// A file that holds a skeleton alone, by its name.
bool isSkeletonFile(const QString& name);

/// The skeleton of a file of any format that can be read, as it is in the file. `warnings`: what was odd.
Result<SkeletonGraph> readSkeleton(const SourceFile& file, Progress& progress, QStringList* warnings = nullptr);

}  // namespace windfall::model
