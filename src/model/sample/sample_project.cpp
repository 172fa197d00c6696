#include "model/sample/sample_project.h"

#include <QBuffer>
#include <algorithm>

#include "model/plant/bodies.h"
#include "model/plant/import.h"
#include "model/progress_part.h"
#include "model/sample/leaf_painter.h"
#include "model/sample/new_project.h"

namespace windfall::model {

namespace {

constexpr int kPhotoSize = 1024, kTextureSize = 512, kSuperpixels = 2000;
constexpr int kVariants = 3;
constexpr int kDotsPerMetre = 2835;  // 72 dpi, whatever the screen

struct SampleLeaf {
  const char* name;
  const char* file;
  PaintedLeaf look;
  quint64 seed;
  double bladeLength;  // m
};

const SampleLeaf kLeaves[] = {
    {"Birch, turning", "birch_turning.png", {LeafShape::Serrate, 0.4, 0}, 11, 0.07},
    {"Birch, yellow", "birch_yellow.png", {LeafShape::Serrate, 0.68, 0}, 12, 0.065},
    {"Maple, red", "maple_red.png", {LeafShape::Maple, 0.85, 1}, 13, 0.11},
};

SourceFile photoOf(const SampleLeaf& sample) {
  QImage picture = paintLeafPhoto(sample.look, sample.seed, kPhotoSize).photo;
  picture.setDotsPerMeterX(kDotsPerMetre);
  picture.setDotsPerMeterY(kDotsPerMetre);
  SourceFile file{QLatin1String(sample.file), {}};
  QBuffer buffer(&file.bytes);
  buffer.open(QIODevice::WriteOnly);
  picture.save(&buffer, "png");
  return file;
}

Plant plantOf(AssetId id, const char* name, const GrowerSettings& grower, std::vector<AssetId> leaves) {
  Plant plant;
  plant.id = id;
  plant.name = QLatin1String(name);
  plant.grower = grower;
  plant.leaves = std::move(leaves);
  return plant;
}

TreePlacement treeOf(AssetId id, const Plant& plant, const QString& name, QVector3D position, double heading,
                     double scale) {
  return {id, name, plant.id, position, heading, scale};
}

}  // namespace

Result<Project> sampleProject(Progress& progress) {
  Project project;
  const auto nextId = [&project] { return AssetId{project.nextId++}; };
  double done = 0;
  for (const SampleLeaf& sample : kLeaves) {
    ProgressPart part(progress, done / std::size(kLeaves) * 0.9, (done + 1) / std::size(kLeaves) * 0.9);
    ++done;
    Leaf leaf;
    leaf.id = nextId();
    leaf.name = QLatin1String(sample.name);
    leaf.photo = photoOf(sample);
    leaf.bladeLength = sample.bladeLength;
    leaf.parameters.synthesis.size = kTextureSize;
    leaf.parameters.synthesis.superpixels = kSuperpixels;
    if (const Status status = synthesizeVariants(leaf, kVariants, part); !status) return status.error();
    project.leaves.push_back(std::move(leaf));
  }

  GrowerSettings birch, maple;
  birch.seed = 5;
  birch.height = 8.5;
  birch.baseRadius = 0.11;
  birch.limbs = 30;
  birch.spread = 48;
  maple.seed = 8;
  maple.height = 6;
  maple.baseRadius = 0.1;
  maple.limbs = 24;
  maple.spread = 62;
  project.plants.push_back(plantOf(nextId(), "Birch", birch, {project.leaves[0].id, project.leaves[1].id}));
  project.plants.push_back(plantOf(nextId(), "Maple", maple, {project.leaves[2].id}));

  const Plant &tall = project.plants[0], &broad = project.plants[1];
  project.scene.trees = {treeOf(nextId(), tall, tall.name, {0, 0, 0}, 0, 1),
                         treeOf(nextId(), broad, broad.name, {5.2f, 0, -2.4f}, 70, 1),
                         treeOf(nextId(), tall, tall.name + QStringLiteral(" 2"), {-5.5f, 0, -4.5f}, 200, 0.78)};
  project.scene.wind.speed = 7;
  project.scene.wind.direction = {1, 0, 0.3f};
  project.scene.wind.turbulence = 0.25f;
  project.scene.wind.gustStrength = 0.9f;
  project.scene.wind.gustPeriod = 7;
  project.scene.leaves.count = 6000;
  project.scene.leaves.season = 0.85f;

  // The camera looks at the first tree; the others stand half behind it.
  const Result<PlantGeometry> geometry = loadGeometry(tall, progress);
  if (!geometry) return geometry.error();
  const PlantInfo info = describe(*geometry, buildBodies(*geometry, tall));
  project.view.camera = cameraFor(info.lower - vec3(2, 0, 0), info.upper + vec3(2, 0, 0));
  progress.report(1);
  return project;
}

}  // namespace windfall::model
