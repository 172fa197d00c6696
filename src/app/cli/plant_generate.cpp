#include "app/cli/plant_generate.h"

#include <QFile>
#include <QFileInfo>
#include <cstdio>

#include "app/cli/interrupt.h"
#include "model/document/durable_file.h"
#include "model/document/project_file.h"
#include "model/export/exporter.h"
#include "model/plant/grow/grow_plant.h"
#include "model/plant/grow/lsystem.h"
#include "model/plant/grow/plant_presets.h"
#include "model/plant/grow/to_graph.h"
#include "model/plant/prim_format.h"
#include "model/sample/new_project.h"

namespace windfall::app {

namespace {

const std::pair<const char*, model::GrowMethod> kMethods[] = {
    {"space-colonization", model::GrowMethod::SpaceColonization},
    {"self-organizing", model::GrowMethod::SelfOrganizing},
    {"l-system", model::GrowMethod::LSystem}};
/// The preset that shows a method where none is named.
const char* presetOf(model::GrowMethod method) {
  return method == model::GrowMethod::SelfOrganizing ? "Pine" : method == model::GrowMethod::LSystem ? "Fir" : "Oak";
}

Result<QString> readRules(const QString& path) {
  QFile file(path);
  if (!file.open(QIODevice::ReadOnly)) return Error{file.errorString().toStdString()};
  if (file.size() > static_cast<qint64>(model::growth::kLongestRules)) return Error{"the rules are longer than 64 KB"};
  return QString::fromUtf8(file.readAll());
}

Status writePlant(model::Plant plant, const QString& path, model::Progress& progress) {
  const QString suffix = QFileInfo(path).suffix().toLower();
  model::Project project;
  plant.id = {project.nextId++};
  if (suffix == QLatin1String("prim")) {
    const Result<model::growth::GrownSkeleton> skeleton = model::growth::growSkeleton(plant, progress);
    if (!skeleton) return skeleton.error();
    const Result<QByteArray> bytes = model::writePrim(model::growth::toGraph(skeleton->grown), 6);
    if (!bytes) return bytes.error();
    return model::writeDurably(path, *bytes);
  }
  const model::AssetId id = plant.id;
  model::TreePlacement tree;
  tree.id = {project.nextId++};
  tree.name = plant.name;
  tree.plant = id;
  project.scene.trees.push_back(tree);
  project.plants.push_back(std::move(plant));
  if (suffix == QLatin1String("windfall")) return model::writeProject(project, path, progress);
  for (const auto& exporter : model::exporters()) {
    if (exporter->subject() == model::ExportSubject::Plant && exporter->extensions().contains(suffix)) {
      return exporter->write(project, id, path, {}, progress);
    }
  }
  return Error{"is no kind of file that a plant can be written to"};
}

}  // namespace

std::shared_ptr<GenerateOptions> declareGenerate(CLI::App& command) {
  auto options = std::make_shared<GenerateOptions>();
  std::vector<std::string> methods;
  for (const auto& [name, method] : kMethods) methods.emplace_back(name);
  command.add_option("--generate", options->method, "Grow a plant: space-colonization, self-organizing or l-system")
      ->check(CLI::IsMember(methods));
  command.add_option("--preset", options->preset,
                     "Kind of plant: oak, birch, aspen, willow, maple, fir, pine, bush, herb, \"dead tree\"");
  command.add_option("--seed", options->seed, "Which plant of its kind")->capture_default_str();
  command.add_option("--age", options->age, "Age in years; default: full-grown")->each([options](const std::string&) {
    options->hasAge = true;
  });
  command.add_option("--rules", options->rules, "L-system rules (docs/lsystem.md) instead of a preset's");
  return options;
}

int generatePlant(const GenerateOptions& options) {
  model::GrowMethod method = model::GrowMethod::SpaceColonization;
  for (const auto& [name, value] : kMethods) {
    if (options.method == name) method = value;
  }
  const model::PresetLibrary library;
  const QString name = options.preset.empty() ? QString::fromLatin1(presetOf(method)) : text(options.preset);
  Result<model::Plant> plant = model::plantOfPreset(library, name, options.seed);
  if (!plant) return fail({}, plant.error());
  model::GrowerSettings& settings = *plant->grower;
  const bool own = settings.method == method;
  if (!own && (options.preset.empty() || method == model::GrowMethod::LSystem) && options.rules.empty()) {
    return fail({}, QStringLiteral("the preset \"%1\" has no rules; give --rules FILE").arg(name));
  }
  settings.method = method;
  QString rulesFile;
  if (!options.rules.empty()) {
    if (method != model::GrowMethod::LSystem) {
      fail({}, QStringLiteral("--rules belongs to --generate l-system"));
      return 2;
    }
    rulesFile = text(options.rules);
    Result<QString> rules = readRules(rulesFile);
    if (!rules) return fail(rulesFile, rules.error());
    settings.lSystem = {*rules, 0};
    plant->name = QFileInfo(rulesFile).completeBaseName();
  }
  if (options.hasAge) settings.age = options.age;
  InterruptProgress progress;
  if (!rulesFile.isEmpty()) {
    // An artist's own rules are tried first, so that what is wrong with them is said with their file.
    const Result<model::growth::GrownSkeleton> tried = model::growth::growSkeleton(*plant, progress);
    if (!tried) return fail(rulesFile, tried.error());
    if (!tried->notes.isEmpty()) return fail(rulesFile, tried->notes.front());
  }
  const QString output = text(options.output);
  if (const Status written = writePlant(std::move(*plant), output, progress); !written)
    return fail(output, written.error());
  return 0;
}

}  // namespace windfall::app
