#include "model/document/check_sources.h"

#include "model/leaf/stages.h"
#include "model/plant/bodies.h"
#include "model/plant/import.h"
#include "model/progress_part.h"

namespace windfall::model {

Result<QStringList> checkSources(const Project& project, Progress& progress) {
  QStringList wrong;
  const auto note = [&wrong](const QString& what, const std::string& message) {
    wrong << what + QStringLiteral(": ") + QString::fromStdString(message);
  };
  const double count = static_cast<double>(project.leaves.size() + project.plants.size());
  double done = 0;
  for (const Leaf& leaf : project.leaves) {
    if (progress.cancelled()) return Error{"cancelled", true};
    progress.report(done++ / count);
    const QString name = QStringLiteral("leaf “%1”").arg(leaf.name);
    if (leaf.photo.isEmpty()) {
      note(name, "has no photo");
      continue;
    }
    const Result<QImage> photo = readPhoto(leaf.photo);
    if (!photo) note(name, photo.error().message);
    if (photo && !leaf.mask.isNull() && leaf.mask.size() != photo->size())
      note(name, "its mask has another size than its photo");
  }
  for (const Plant& plant : project.plants) {
    ProgressPart part(progress, done / count, (done + 1) / count);
    ++done;
    const Result<PlantGeometry> geometry = loadGeometry(plant, part);
    if (progress.cancelled()) return Error{"cancelled", true};
    const QString name = QStringLiteral("plant “%1”").arg(plant.name);
    if (!geometry) {
      note(name, geometry.error().message);
      continue;
    }
    if (buildBodies(*geometry, plant).tree.links.empty()) note(name, "has no branch that could sway");
  }
  return wrong;
}

}  // namespace windfall::model
