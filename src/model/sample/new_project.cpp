#include "model/sample/new_project.h"

#include <QFileInfo>
#include <algorithm>
#include <cmath>

#include "model/document/names.h"
#include "model/leaf/stages.h"
#include "model/plant/bodies.h"
#include "model/plant/import.h"
#include "model/progress_part.h"

namespace windfall::model {

namespace {

QString nameOf(const SourceFile& file) {
  return QFileInfo(file.name).completeBaseName().replace('_', ' ').simplified();
}

Error inFile(const SourceFile& file, const Error& error) {
  return Error{file.name.toStdString() + ": " + error.message, error.cancelled};
}

template <class T>
QStringList namesOf(const std::vector<T>& items) {
  QStringList names;
  for (const T& item : items) names << item.name;
  return names;
}

}  // namespace

Status synthesizeVariants(Leaf& leaf, int count, Progress& progress) {
  ProgressPart analysis(progress, 0, 0.4);
  const Result<LeafStages> stages = computeStages(leaf, Stage::Superpixels, analysis);
  if (!stages) return stages.error();
  quint64 seed = 0;
  for (const Variant& variant : leaf.variants) seed = std::max(seed, variant.seed);
  std::vector<Variant> made;
  for (int i = 0; i < count; ++i) {
    ProgressPart part(progress, 0.4 + 0.6 * i / count, 0.4 + 0.6 * (i + 1) / count);
    Result<QImage> image = synthesize(*stages, *stages, leaf.parameters.synthesis, ++seed, part);
    if (!image) return image.error();
    made.push_back({seed, true, std::move(*image)});
  }
  leaf.variants.insert(leaf.variants.end(), made.begin(), made.end());
  return ok();
}

Camera cameraFor(const vec3& lower, const vec3& upper) {
  Camera camera;
  const vec3 middle = 0.5f * (lower + upper);
  const double height = std::max(0.1, static_cast<double>(upper.y - lower.y));
  const double width = std::max({0.1, static_cast<double>(upper.x - lower.x), static_cast<double>(upper.z - lower.z)});
  // A little below the middle, so that ground for the fallen leaves is in the picture.
  camera.target = {middle.x, lower.y + static_cast<float>(0.46 * height), middle.z};
  const double half = camera.fieldOfView * M_PI / 360;
  // The picture is wider than high, so a broad box needs less room than a tall one.
  camera.distance = 0.5 * std::max(1.2 * height, 0.9 * width) / std::tan(half) + 0.3 * width;
  return camera;
}

Result<Project> projectFromFiles(const std::vector<SourceFile>& photos, const std::vector<SourceFile>& plants,
                                 int variants, Progress& progress) {
  Project project;
  const double count = static_cast<double>(photos.size() + plants.size());
  double done = 0;
  for (const SourceFile& photo : photos) {
    ProgressPart part(progress, done / count, (done + 1) / count);
    ++done;
    Leaf leaf;
    leaf.id = {project.nextId++};
    leaf.name = uniqueName(nameOf(photo), namesOf(project.leaves), QStringLiteral("Leaf"));
    leaf.photo = photo;
    if (const Status status = synthesizeVariants(leaf, variants, part); !status) return inFile(photo, status.error());
    project.leaves.push_back(std::move(leaf));
  }
  for (const SourceFile& file : plants) {
    ProgressPart part(progress, done / count, (done + 1) / count);
    ++done;
    Plant plant;
    plant.id = {project.nextId++};
    plant.name = uniqueName(nameOf(file), namesOf(project.plants), QStringLiteral("Plant"));
    plant.file = file;
    for (const Leaf& leaf : project.leaves) plant.leaves.push_back(leaf.id);
    const Result<PlantGeometry> geometry = loadGeometry(plant, part);
    if (!geometry) return inFile(file, geometry.error());
    if (project.plants.empty()) {
      const PlantInfo info = describe(*geometry, buildBodies(*geometry, plant));
      project.view.camera = cameraFor(info.lower, info.upper);
      TreePlacement tree;
      tree.id = {project.nextId++};
      tree.name = plant.name;
      tree.plant = plant.id;
      project.scene.trees.push_back(tree);
    }
    project.plants.push_back(std::move(plant));
  }
  return project;
}

}  // namespace windfall::model
