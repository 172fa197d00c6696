#include "model/plant/import.h"

#include <QFileInfo>

#include "model/plant/assimp_importer.h"
#include "model/plant/grow/grow_plant.h"
#include "model/plant/grower.h"

namespace windfall::model {

const std::vector<std::unique_ptr<PlantImporter>>& plantImporters() {
  static const std::vector<std::unique_ptr<PlantImporter>> all = [] {
    std::vector<std::unique_ptr<PlantImporter>> importers;
    importers.push_back(std::make_unique<AssimpImporter>());
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

Result<PlantGeometry> loadGeometry(const Plant& plant, Progress& progress) {
  if (plant.file.isEmpty() && plant.grower) {
    const bool byRule = plant.grower->method == GrowMethod::Rule;
    return byRule ? grow(*plant.grower, progress) : growth::growPlant(plant, progress);
  }
  const QString extension = QFileInfo(plant.file.name).suffix().toLower();
  for (const auto& importer : plantImporters()) {
    if (importer->extensions().contains(extension)) return importer->read(plant.file, progress);
  }
  return Error{"is no plant file that Windfall reads (" + plantFilePatterns().join(' ').toStdString() + ")"};
}

}  // namespace windfall::model
