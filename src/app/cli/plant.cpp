#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <cstdio>

#include "app/cli/commands.h"
#include "app/cli/interrupt.h"
#include "app/cli/plant_export.h"
#include "app/cli/plant_generate.h"
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
  CLI::App* command =
      app.add_subcommand("plant", "Look into a plant file, grow a plant, or write it in another format");
  auto file = std::make_shared<std::string>(), output = std::make_shared<std::string>();
  command->add_option("FILE", *file, "Plant: .fbx, .glb, .gltf, .prim or .json; to write, a project too");
  auto info = std::make_shared<bool>(false);
  const std::string what = "Print what is in it as one JSON object: lengths in m, mass in kg, frequency in Hz";
  command->add_flag("--info", *info, what);
  command->add_option("-o,--output", *output, "The file to write: .glb, .gltf, .obj, .prim, .json or .windfall");
  const std::shared_ptr<PlantExportCli> options = declarePlantExport(*command);
  const std::shared_ptr<GenerateOptions> generate = declareGenerate(*command);
  command->callback([file, info, output, options, generate, &action] {
    if (!generate->method.empty()) {
      if (output->empty()) throw CLI::RequiredError("--output");
      generate->output = *output;
      action = [generate] { return generatePlant(*generate); };
      return;
    }
    if (file->empty()) throw CLI::RequiredError("FILE or --generate");
    if (!*info && output->empty()) throw CLI::RequiredError("--info or --output");
    action = [file, info, output, options] {
      if (!output->empty()) {
        if (const int status = exportPlant(*file, *output, *options); status != 0) return status;
      }
      return *info ? plantInfo(text(*file)) : 0;
    };
  });
}

}  // namespace windfall::app
