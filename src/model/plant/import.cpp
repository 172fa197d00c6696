#include "model/plant/import.h"

#include <QFileInfo>
#include <QObject>

#include "model/plant/assimp_importer.h"
#include "model/plant/grow/edit_graph.h"
#include "model/plant/grow/grow_plant.h"
#include "model/plant/grower.h"
#include "model/plant/skeleton_geometry.h"
#include "model/plant/skeleton_importer.h"

namespace windfall::model {

const std::vector<std::unique_ptr<PlantImporter>>& plantImporters() {
  static const std::vector<std::unique_ptr<PlantImporter>> all = [] {
    std::vector<std::unique_ptr<PlantImporter>> importers;
    importers.push_back(std::make_unique<AssimpImporter>());
    importers.push_back(std::make_unique<PrimImporter>());
    importers.push_back(std::make_unique<JsonSkeletonImporter>());
    return importers;
  }();
  return all;
}

QStringList plantFilePatterns() {
  QStringList patterns;
  for (const auto& importer : plantImporters()) {
    for (const QString& extension : importer->extensions()) patterns << "*." + extension;
  }
  return patterns;
}

namespace {

/// A skeleton that was shaped by hand after it was read.
Result<PlantGeometry> shapedSkeleton(const Plant& plant, const QString& format, WoodMesh wood, Progress& progress) {
  const Result<SkeletonGraph> graph = readSkeleton(plant.file, progress);
  if (!graph) return graph.error();
  std::vector<int> lost;
  const SkeletonGraph shaped = growth::withEdits(*graph, plant.handEdits, &lost);
  if (shaped.segments.empty()) return Error{"nothing is left of it after the edits by hand"};
  Result<PlantGeometry> geometry = geometryOf(shaped, plant.surface, format, progress, wood);
  if (!geometry) return geometry;
  for (const int index : lost) geometry->notes << QObject::tr("edit %1 found no branch to work on").arg(index + 1);
  return geometry;
}

}  // namespace

bool canBeShaped(const Plant& plant) {
  if (plant.file.isEmpty()) return plant.grower && plant.grower->method != GrowMethod::Rule;
  return isSkeletonFile(plant.file.name);
}

Result<PlantGeometry> loadGeometry(const Plant& plant, Progress& progress, WoodMesh wood) {
  if (plant.file.isEmpty() && plant.grower) {
    const bool byRule = plant.grower->method == GrowMethod::Rule;
    return byRule ? grow(*plant.grower, progress, wood) : growth::growPlant(plant, progress, wood);
  }
  const QString extension = QFileInfo(plant.file.name).suffix().toLower();
  if (!plant.handEdits.empty() && canBeShaped(plant)) return shapedSkeleton(plant, extension, wood, progress);
  for (const auto& importer : plantImporters()) {
    if (importer->extensions().contains(extension)) return importer->read(plant.file, plant.surface, wood, progress);
  }
  return Error{"is no plant file that Windfall reads (" + plantFilePatterns().join(' ').toStdString() + ")"};
}

}  // namespace windfall::model
