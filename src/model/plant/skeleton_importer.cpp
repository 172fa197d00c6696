#include "model/plant/skeleton_importer.h"

#include <QFileInfo>

#include "model/plant/json_skeleton.h"
#include "model/plant/prim_format.h"
#include "model/plant/skeleton_geometry.h"

namespace windfall::model {

Result<PlantGeometry> PrimImporter::read(const SourceFile& file, const SurfaceSettings& surface, WoodMesh wood,
                                         Progress& progress) const {
  const Result<PrimFile> read = readPrim(file.bytes);
  if (!read) return read.error();
  progress.report(0.3);
  return geometryOf(read->graph, surface, QStringLiteral("prim"), progress, wood);
}

Result<PlantGeometry> JsonSkeletonImporter::read(const SourceFile& file, const SurfaceSettings& surface, WoodMesh wood,
                                                 Progress& progress) const {
  const Result<JsonSkeleton> read = readJsonSkeleton(file.bytes);
  if (!read) return read.error();
  progress.report(0.3);
  return geometryOf(read->graph, surface, QStringLiteral("json"), progress, wood);
}

bool isSkeletonFile(const QString& name) {
  return QStringList{"prim", "json"}.contains(QFileInfo(name).suffix().toLower());
}

Result<SkeletonGraph> readSkeleton(const SourceFile& file, Progress& progress, QStringList* warnings) {
  const QString extension = QFileInfo(file.name).suffix().toLower();
  QStringList odd;
  Result<SkeletonGraph> graph = Error{"is no plant file that Windfall reads"};
  if (extension == QLatin1String("prim")) {
    Result<PrimFile> read = readPrim(file.bytes);
    if (!read) return read.error();
    odd = read->warnings, graph = std::move(read->graph);
  } else if (extension == QLatin1String("json")) {
    Result<JsonSkeleton> read = readJsonSkeleton(file.bytes);
    if (!read) return read.error();
    odd = read->warnings, graph = std::move(read->graph);
  } else {
    Plant plant;
    plant.file = file;
    Result<PlantGeometry> geometry = loadGeometry(plant, progress);
    if (!geometry) return geometry.error();
    graph = graphOf(*geometry);
  }
  if (warnings != nullptr) *warnings = odd;
  return graph;
}

}  // namespace windfall::model
