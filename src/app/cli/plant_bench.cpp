#include "app/cli/plant_bench.h"

#include <QCoreApplication>
#include <QFile>
#include <QProcess>
#include <QTemporaryDir>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <string>

#include "app/cli/commands.h"
#include "model/document/project_file.h"
#include "model/plant/grow/grow_plant.h"
#include "model/plant/grow/plant_presets.h"
#include "model/scene/assemble.h"
#include "sim/engine.h"
#include "widgets/render/offscreen_context.h"
#include "widgets/render/renderer.h"
#include "widgets/viewport/scene_content.h"
#include "widgets/viewport/scene_view.h"

namespace windfall::app {

namespace {

constexpr double kOrgans = 10'000;

model::Plant preset(const char* name) {
  Result<model::Plant> plant = model::plantOfPreset(model::PresetLibrary(), QLatin1String(name), 1);
  return plant ? std::move(*plant) : model::Plant{};
}

/// An oak of 50,000 organs: stems and leaves together.
model::Plant largeTree() {
  model::Plant oak = preset("Oak");
  if (!oak.grower) return oak;
  model::Progress progress;
  const Result<model::growth::GrownSkeleton> skeleton = model::growth::growSkeleton(oak, progress);
  const double links = skeleton ? static_cast<double>(skeleton->grown.size()) - 1 : 0;
  // The rest are leaves.
  const Result<model::PlantGeometry> whole = model::growth::growPlant(oak, progress);
  const double leaves = whole ? static_cast<double>(whole->leafSites.size()) : 1;
  oak.grower->foliage.amount *= std::clamp((5 * kOrgans - links) / leaves, 0.0, 10.0);
  return oak;
}

/// The process' memory at its highest, MB.
double peakMemory() {
  QFile file(QStringLiteral("/proc/self/status"));
  if (!file.open(QIODevice::ReadOnly)) return 0;
  for (const QByteArray& line : file.readAll().split('\n')) {
    if (line.startsWith("VmHWM:")) return line.mid(6).trimmed().split(' ').first().toDouble() / 1024;
  }
  return 0;
}

std::vector<sim::Contender> growthContenders() {
  std::vector<sim::Contender> contenders;
  for (const auto& [name, kind] :
       {std::pair{"space colonization, oak", "Oak"}, {"self-organizing, pine", "Pine"}, {"L-system, fir", "Fir"}}) {
    auto plant = std::make_shared<model::Plant>(preset(kind));
    model::Progress progress;
    const Result<model::growth::GrownSkeleton> once = model::growth::growSkeleton(*plant, progress);
    if (!once) continue;
    contenders.push_back({name,
                          [plant] {
                            model::Progress quiet;
                            const auto grown = model::growth::growSkeleton(*plant, quiet);
                            if (!grown) std::fprintf(stderr, "%s\n", grown.error().message.c_str());
                          },
                          static_cast<double>(once->grown.size() - 1) / kOrgans});
  }
  return contenders;
}

std::vector<sim::Contender> meshContenders() {
  const model::Plant plant = largeTree();
  model::Progress progress;
  Result<model::growth::GrownSkeleton> skeleton = model::growth::growSkeleton(plant, progress);
  if (!skeleton) return {};
  auto grown = std::make_shared<model::growth::Grown>(std::move(skeleton->grown));
  const model::PlantGeometry once = model::growth::dress(*grown, *plant.grower);
  const double organs = static_cast<double>(once.bones.size() + once.leafSites.size());
  char name[80];
  std::snprintf(name, sizeof name, "%.0f organs, %.0f vertices", organs, static_cast<double>(once.vertices.size()));
  return {{name, [grown, settings = *plant.grower] { const auto geometry = model::growth::dress(*grown, settings); },
           organs / kOrgans}};
}

/// What stays between pictures: a program has its context before it opens a file.
struct Stage {
  std::unique_ptr<render::OffscreenContext> context;
  std::unique_ptr<render::Renderer> renderer;
  QTemporaryDir folder;
};

/// ms since `begin`.
double since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

/// ms from the file to a picture, and to the fine one where that was coarse, as in the window.
struct PictureTimes {
  double first = 0, fine = 0;
};

Result<PictureTimes> firstPicture(const Stage& stage, const QString& file) {
  const auto begin = std::chrono::steady_clock::now();
  model::Progress progress;
  const Result<model::Project> project = model::readProject(file, progress);
  if (!project) return project.error();
  const Result<model::SceneAssembly> assembly = model::assembleScene(*project, progress);
  if (!assembly) return assembly.error();
  const Result<std::unique_ptr<sim::Engine>> engine = sim::Engine::create(assembly->sim, sim::Device::Cpu);
  if (!engine) return engine.error();
  if (const Status set =
          stage.renderer->setContent(widgets::makeContent(*assembly, project->scene, (*engine)->leafCount()));
      !set)
    return set.error();
  render::View view = widgets::sceneView(project->view.camera, project->scene);
  view.width = 1280, view.height = 720;
  const render::FrameSlot slot = stage.renderer->acquire();
  (*engine)->write(slot.bones, slot.leaves);
  stage.renderer->publish(slot);
  PictureTimes times;
  view.coarse = stage.renderer->isSoftware();
  for (double* time : {&times.first, &times.fine}) {
    if (const Status drawn = stage.renderer->draw(view, stage.context->framebuffer()); !drawn) return drawn.error();
    stage.context->read();
    *time = since(begin);
    view.coarse = false;
  }
  return times;
}

/// A project of the large tree alone.
Result<QString> largeProject(const QTemporaryDir& folder, bool adaptive) {
  model::Project project;
  model::Plant plant = largeTree();
  plant.id = {project.nextId++};
  model::TreePlacement tree;
  tree.id = {project.nextId++};
  tree.plant = plant.id;
  project.plants = {plant};
  project.scene.trees = {tree};
  project.scene.leaves.season = 0;
  project.scene.detail.adaptive = adaptive;
  project.view.camera.target = {0, 8, 0};
  project.view.camera.distance = 30;
  const QString file = folder.filePath(adaptive ? QStringLiteral("adaptive") : QStringLiteral("whole"));
  model::Progress progress;
  if (const auto written = model::writeProject(project, file, progress); !written) return written.error();
  return file;
}

}  // namespace

std::vector<sim::Benchmark> plantBenchmarks() {
  return {
      {"plant growth", "Skeletons by the growers, one after the other", "ms per 10,000 links", 1e3, growthContenders},
      {"plant dressing", "Bark, bones and leaves of a grown tree", "ms per 10,000 organs", 1e3, meshContenders}};
}

int timeFirstPicture(const QString& file, int rounds) {
  Stage stage;
  Result<std::unique_ptr<render::OffscreenContext>> context = render::OffscreenContext::create(1280, 720);
  if (!context) return fail(QString(), context.error());
  Result<std::unique_ptr<render::Renderer>> renderer = render::Renderer::create();
  if (!renderer) return fail(QString(), renderer.error());
  stage.context = std::move(*context);
  stage.renderer = std::move(*renderer);
  // The first compiles what the graphics driver has not seen yet, and tells the memory of a picture.
  if (const auto drawn = firstPicture(stage, file); !drawn) return fail(file, drawn.error());
  std::printf("%.1f\n", peakMemory());
  for (int round = 0; round < rounds; ++round) {
    const Result<PictureTimes> times = firstPicture(stage, file);
    if (!times) return fail(file, times.error());
    std::printf("%.1f %.1f\n", times->first, times->fine);
  }
  return 0;
}

Result<sim::BenchmarkResult> benchFirstPicture(int rounds) {
  sim::BenchmarkResult result{
      "plant first picture", "A tree of 50,000 organs from its project file to its first picture", "ms", rounds, {}};
  const QTemporaryDir folder;
  for (const bool adaptive : {true, false}) {
    const Result<QString> file = largeProject(folder, adaptive);
    if (!file) return file.error();
    // A process of its own, so that its memory is its own too.
    QProcess process;
    process.setProcessChannelMode(QProcess::ForwardedErrorChannel);
    process.start(QCoreApplication::applicationFilePath(),
                  {QStringLiteral("bench"), QStringLiteral("--first-picture"), *file, QStringLiteral("--rounds"),
                   QString::number(rounds)});
    if (!process.waitForFinished(-1) || process.exitStatus() != QProcess::NormalExit || process.exitCode() != 0) {
      return Error{"the first picture did not end well"};
    }
    const QList<QByteArray> lines = process.readAllStandardOutput().trimmed().split('\n');
    std::vector<double> first, fine;
    for (qsizetype i = 1; i < lines.size(); ++i) {
      const QList<QByteArray> figures = lines[i].trimmed().split(' ');
      first.push_back(figures.front().toDouble());
      fine.push_back(figures.back().toDouble());
    }
    if (first.empty()) return Error{"the first picture told no times"};
    std::sort(first.begin(), first.end());
    std::sort(fine.begin(), fine.end());
    char note[96];
    std::snprintf(note, sizeof note, "memory at most %.0f MB", lines.front().toDouble());
    const std::string name = adaptive ? "50,000 organs, adaptive wood" : "50,000 organs, whole mesh";
    result.contenders.push_back({name, first.front(), first[first.size() / 2], 0, note});
    result.contenders.push_back({name + ", fine", fine.front(), fine[fine.size() / 2], 0, {}});
  }
  return result;
}

}  // namespace windfall::app
