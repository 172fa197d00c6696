#include "app/cli/plant_bench.h"

#include <QFile>
#include <QTemporaryDir>
#include <algorithm>
#include <cstdio>
#include <memory>

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

Status firstPicture(const Stage& stage, const QString& file) {
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
    return set;
  render::View view = widgets::sceneView(project->view.camera, project->scene);
  view.width = 1280, view.height = 720;
  const render::FrameSlot slot = stage.renderer->acquire();
  (*engine)->write(slot.bones, slot.leaves);
  stage.renderer->publish(slot);
  if (const Status drawn = stage.renderer->draw(view, stage.context->framebuffer()); !drawn) return drawn;
  stage.context->read();
  return ok();
}

std::vector<sim::Contender> pictureContenders() {
  auto stage = std::make_shared<Stage>();
  Result<std::unique_ptr<render::OffscreenContext>> context = render::OffscreenContext::create(1280, 720);
  if (!context) return {};
  Result<std::unique_ptr<render::Renderer>> renderer = render::Renderer::create();
  if (!renderer) return {};
  stage->context = std::move(*context);
  stage->renderer = std::move(*renderer);
  model::Project project;
  model::Plant plant = largeTree();
  plant.id = {project.nextId++};
  model::TreePlacement tree;
  tree.id = {project.nextId++};
  tree.plant = plant.id;
  project.plants = {plant};
  project.scene.trees = {tree};
  project.scene.leaves.season = 0;
  project.view.camera.target = {0, 8, 0};
  project.view.camera.distance = 30;
  std::vector<sim::Contender> contenders;
  for (const bool adaptive : {false, true}) {
    project.scene.detail.adaptive = adaptive;
    const QString file = stage->folder.filePath(adaptive ? QStringLiteral("adaptive") : QStringLiteral("whole"));
    model::Progress progress;
    if (!model::writeProject(project, file, progress)) return {};
    if (const Status drawn = firstPicture(*stage, file); !drawn) {
      std::fprintf(stderr, "%s\n", drawn.error().message.c_str());
      return {};
    }
    char name[96];
    std::snprintf(name, sizeof name, "50,000 organs, %s (so far at most %.0f MB)",
                  adaptive ? "adaptive wood" : "whole mesh", peakMemory());
    contenders.push_back({name, [stage, file] { (void)firstPicture(*stage, file); }, 1});
  }
  return contenders;
}

}  // namespace

std::vector<sim::Benchmark> plantBenchmarks() {
  return {
      {"plant growth", "Skeletons by the growers, one after the other", "ms per 10,000 links", 1e3, growthContenders},
      {"plant dressing", "Bark, bones and leaves of a grown tree", "ms per 10,000 organs", 1e3, meshContenders},
      {"plant first picture", "A tree of 50,000 organs from its project file to its first picture", "ms", 1e3,
       pictureContenders}};
}

}  // namespace windfall::app
