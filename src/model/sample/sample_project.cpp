#include "model/sample/sample_project.h"

#include <QBuffer>
#include <algorithm>

#include "model/progress_part.h"
#include "model/sample/leaf_painter.h"
#include "model/sample/new_project.h"
#include "model/scene/assemble.h"
#include "sim/engine.h"

namespace windfall::model {

namespace {

constexpr int kPhotoSize = 1024, kTextureSize = 512, kSuperpixels = 2000;
constexpr int kVariants = 3;
constexpr double kOpensAt = 3;       // s
constexpr int kDotsPerMetre = 2835;  // 72 dpi, whatever the screen

struct SampleLeaf {
  const char* name;
  const char* file;
  PaintedLeaf look;
  quint64 seed;
  double bladeLength;  // m
};

const SampleLeaf kLeaves[] = {
    {"Birch, turning", "birch_turning.png", {LeafShape::Serrate, 0.4, 0}, 11, 0.10},
    {"Birch, yellow", "birch_yellow.png", {LeafShape::Serrate, 0.68, 0}, 12, 0.10},
    {"Maple, red", "maple_red.png", {LeafShape::Maple, 0.85, 1}, 13, 0.14},
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
  birch.limbs = 46;
  birch.levels = 4;
  birch.spread = 48;
  maple.seed = 8;
  maple.height = 7;
  maple.baseRadius = 0.1;
  maple.limbs = 40;
  maple.levels = 4;
  maple.spread = 62;
  project.plants.push_back(plantOf(nextId(), "Birch", birch, {project.leaves[0].id, project.leaves[1].id}));
  project.plants.push_back(plantOf(nextId(), "Maple", maple, {project.leaves[2].id}));

  const Plant &tall = project.plants[0], &broad = project.plants[1];
  project.scene.trees = {treeOf(nextId(), tall, tall.name, {0, 0, 0}, 0, 1),
                         treeOf(nextId(), broad, broad.name, {5.2f, 0, -2.4f}, 70, 1),
                         treeOf(nextId(), tall, tall.name + QStringLiteral(" 2"), {-5.5f, 0, -4.5f}, 200, 0.78)};
  project.scene.wind.speed = 8;
  project.scene.wind.direction = {1, 0, 0.3f};
  project.scene.wind.turbulence = 0.25f;
  project.scene.wind.gustStrength = 0.9f;
  project.scene.wind.gustPeriod = 7;
  project.scene.leaves.count = 80000;
  project.scene.leaves.season = 0.5f;

  // Low light from behind the camera's left shoulder, seen from a child's height.
  project.scene.light = {225, 26, 1};
  project.view.camera.target = {1.3f, 4.1f, 0};
  project.view.camera.azimuth = 20;
  project.view.camera.elevation = -1;
  project.view.camera.distance = 13.5;
  project.view.camera.fieldOfView = 42;

  // It opens where the first gust has passed and leaves are in the air; Reset goes back to the start.
  Progress part;
  const Result<SceneAssembly> assembly = assembleScene(project, part);
  if (!assembly) return assembly.error();
  const Result<std::unique_ptr<sim::Engine>> engine = sim::Engine::create(assembly->sim, sim::Device::Cpu);
  if (!engine) return engine.error();
  while ((*engine)->time() < kOpensAt) {
    if (progress.cancelled()) return Error{"cancelled", true};
    (*engine)->step();
  }
  const std::vector<std::uint8_t> state = (*engine)->save();
  project.simulation.time = (*engine)->time();
  project.simulation.bytes =
      QByteArray(reinterpret_cast<const char*>(state.data()), static_cast<qsizetype>(state.size()));
  progress.report(1);
  return project;
}

}  // namespace windfall::model
