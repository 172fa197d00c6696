#include "app/cli/plant_export.h"

#include <QFileInfo>
#include <algorithm>
#include <cstdio>

#include "app/cli/command.h"
#include "app/cli/interrupt.h"
#include "model/document/durable_file.h"
#include "model/document/project_file.h"
#include "model/export/exporter.h"
#include "model/plant/grow/edit_graph.h"
#include "model/plant/import.h"
#include "model/plant/json_skeleton.h"
#include "model/plant/prim_format.h"
#include "model/plant/skeleton_geometry.h"
#include "model/plant/skeleton_importer.h"

namespace windfall::app {

namespace {

constexpr const char* kBarks[] = {"oak", "birch", "beech", "pine", "maple", "herb"};
constexpr const char* kLeafMeshes[] = {"automatic", "fine", "medium", "hull", "rectangle"};
constexpr const char* kLeaves[] = {"instances", "merged", "nodes", "none"};

template <std::size_t n>
int placeOf(const char* const (&names)[n], const std::string& name) {
  return static_cast<int>(std::find(std::begin(names), std::end(names), name) - std::begin(names));
}

std::vector<std::string> all(const char* const* first, std::size_t count) { return {first, first + count}; }

Result<model::Project> openPlant(const QString& path, model::Progress& progress) {
  if (!model::plantFilePatterns().contains("*." + QFileInfo(path).suffix().toLower())) {
    return model::readProject(path, progress);
  }
  Result<model::SourceFile> source = model::readSourceFile(path);
  if (!source) return source.error();
  model::Project project;
  model::Plant plant;
  plant.id = {1};
  plant.name = QFileInfo(path).completeBaseName();
  plant.file = std::move(*source);
  project.nextId = 2;
  project.plants.push_back(std::move(plant));
  return project;
}

const model::Plant* choose(const model::Project& project, const QString& name) {
  for (const model::Plant& plant : project.plants) {
    if (name.isEmpty() || plant.name == name) return &plant;
  }
  return nullptr;
}

/// The graph as its source has it; of grown plants, as it is meshed.
Result<model::SkeletonGraph> graphOf(const model::Plant& plant, model::Progress& progress) {
  if (!plant.file.isEmpty()) {
    const Result<model::SkeletonGraph> read = model::readSkeleton(plant.file, progress);
    if (!read) return read.error();
    return model::isSkeletonFile(plant.file.name) ? model::growth::withEdits(*read, plant.handEdits) : *read;
  }
  const Result<model::PlantGeometry> geometry = model::loadGeometry(plant, progress);
  if (!geometry) return geometry.error();
  if (!geometry->skeleton) return Error{"has no skeleton"};
  return geometry->skeleton->graph;
}

Result<QByteArray> skeletonBytes(const model::Plant& plant, bool prim, const PlantExportCli& options,
                                 model::Progress& progress) {
  const Result<model::SkeletonGraph> graph = graphOf(plant, progress);
  if (!graph) return graph.error();
  if (!prim) {
    model::ChainSettings chains;
    if (options.chains == "longest") chains.rule = model::ChainRule::Longest;
    return model::writeJsonSkeleton(*graph, model::findChains(*graph, chains).ofSegment);
  }
  const auto root = [](const model::Segment& s) { return s.kind == model::SegmentKind::Root; };
  const bool roots = std::any_of(graph->segments.begin(), graph->segments.end(), root);
  return model::writePrim(*graph, options.primVersion > 0 ? options.primVersion : roots ? 6 : 4);
}

}  // namespace

std::shared_ptr<PlantExportCli> declarePlantExport(CLI::App& command) {
  auto o = std::make_shared<PlantExportCli>();
  command.add_option("--detail", o->detail, "How fine the mesh is, 0 (4 mm) to 1 (0.05 mm); default: the plant's own")
      ->check(CLI::Range(0.0, 1.0));
  command.add_option("--bones", o->bones, "Bones at most; 0: all")->check(CLI::Range(0, 65535));
  command.add_option("--depth", o->depth, "Bones from root to tip at most; 0: any")->check(CLI::Range(0, 100'000));
  command.add_option("--leaves", o->leaves, "How leaves are written")
      ->check(CLI::IsMember(all(kLeaves, std::size(kLeaves))))
      ->capture_default_str();
  command.add_option("--leaf-mesh", o->leafMesh, "How finely a leaf follows its contour; hull and rectangle are flat")
      ->check(CLI::IsMember(all(kLeafMeshes, std::size(kLeafMeshes))))
      ->capture_default_str();
  command.add_option("--levels", o->levels, "Levels of detail")->check(CLI::Range(1, 4))->capture_default_str();
  command.add_option("--prim-version", o->primVersion, "Version of a .prim: 3 to 6")->check(CLI::Range(3, 6));
  command.add_option("--chains", o->chains, "What continues a branch")
      ->check(CLI::IsMember({"score", "longest"}))
      ->capture_default_str();
  command.add_option("--bark", o->bark, "Bark of skeletons")->check(CLI::IsMember(all(kBarks, std::size(kBarks))));
  command.add_option("--plant", o->plant, "Which plant of a project; default: the first");
  return o;
}

int exportPlant(const std::string& file, const std::string& output, const PlantExportCli& options) {
  const QString path = text(file), target = text(output);
  const QString suffix = QFileInfo(target).suffix().toLower();
  const QString formats = QStringLiteral("is no format that plants are written in (.glb, .gltf, .obj, .prim, .json)");
  if (!QStringList{"glb", "gltf", "obj", "prim", "json"}.contains(suffix)) return fail(target, formats);
  if (!QFileInfo(QFileInfo(target).absolutePath()).isDir()) {
    return fail(target, QStringLiteral("its folder does not exist"));
  }
  InterruptProgress progress;
  Result<model::Project> project = openPlant(path, progress);
  if (!project) return fail(path, project.error());
  const model::Plant* chosen = choose(*project, text(options.plant));
  if (chosen == nullptr) return fail(path, QStringLiteral("has no such plant"));
  if (suffix == QLatin1String("prim") || suffix == QLatin1String("json")) {
    const Result<QByteArray> bytes = skeletonBytes(*chosen, suffix == QLatin1String("prim"), options, progress);
    if (!bytes) return fail(path, bytes.error());
    const Status written = model::writeDurably(target, *bytes);
    return written ? 0 : fail(target, written.error());
  }
  model::Plant& plant = *project->plant(chosen->id);
  if (options.chains == "longest") plant.surface.chains.rule = model::ChainRule::Longest;
  if (!options.bark.empty()) plant.surface.bark = static_cast<model::BarkKind>(placeOf(kBarks, options.bark));
  QJsonObject values{{"bones", options.bones},
                     {"depth", options.depth},
                     {"leaves", placeOf(kLeaves, options.leaves)},
                     {"leafMesh", placeOf(kLeafMeshes, options.leafMesh)},
                     {"levels", options.levels}};
  if (options.detail >= 0) values["detail"] = options.detail;
  const model::Exporter* exporter = model::findExporter(suffix == QLatin1String("obj") ? "obj" : "gltf");
  const Status written = exporter->write(*project, plant.id, target, values, progress);
  return written ? 0 : fail(target, written.error());
}

}  // namespace windfall::app
