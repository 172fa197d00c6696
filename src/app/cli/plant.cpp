#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <cstdio>

#include "app/cli/commands.h"
#include "app/cli/interrupt.h"
#include "model/plant/bodies.h"
#include "model/plant/import.h"

namespace windfall::app {

namespace {

QJsonArray coordinates(vec3 v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

QJsonObject json(const model::PlantInfo& info) {
  return {{"format", info.format},
          {"plants", info.plants},
          {"nodes", info.nodes},
          {"bones", info.bones},
          {"rigidBodies", info.rigidBodies},
          {"chains", info.chains},
          {"depth", info.depth},
          {"stems", info.stems},
          {"leaves", info.leaves},
          {"buds", info.buds},
          {"maxInfluences", info.maxInfluences},
          {"totalStemLength", info.totalStemLength},
          {"mass", info.mass},
          {"firstFrequency", info.firstFrequency},
          {"selfBuckling", info.selfBuckling},
          {"clips", QJsonArray::fromStringList(info.clips)},
          {"notes", QJsonArray::fromStringList(info.notes)},
          {"boundingBox", QJsonObject{{"min", coordinates(info.lower)}, {"max", coordinates(info.upper)}}}};
}

int plantInfo(const QString& path) {
  Result<model::SourceFile> source = model::readSourceFile(path);
  if (!source) return fail(path, source.error());
  model::Plant plant;
  plant.file = std::move(*source);
  InterruptProgress progress;
  const Result<model::PlantGeometry> geometry = model::loadGeometry(plant, progress);
  if (!geometry) return fail(path, geometry.error());
  const model::PlantInfo info = model::describe(*geometry, model::buildBodies(*geometry, plant));
  std::fputs(QJsonDocument(json(info)).toJson().constData(), stdout);
  return 0;
}

}  // namespace

void declarePlant(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("plant", "Look into a plant file");
  auto file = std::make_shared<std::string>();
  command->add_option("FILE", *file, "Plant with an armature: .fbx, .glb or .gltf")->required();
  const std::string what = "Print what is in it as one JSON object: lengths in m, mass in kg, frequency in Hz";
  command->add_flag("--info", what)->required();
  command->callback([file, &action] { action = [file] { return plantInfo(text(*file)); }; });
}

}  // namespace windfall::app
