#include "app/cli/foliage_bench.h"

#include <QDir>
#include <QImage>
#include <QString>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>

#include "model/plant/grow/plant_presets.h"
#include "model/scene/assemble.h"
#include "sim/engine.h"
#include "widgets/render/offscreen_context.h"
#include "widgets/render/renderer.h"
#include "widgets/viewport/scene_content.h"
#include "widgets/viewport/scene_view.h"

namespace windfall::app {

namespace {

constexpr int kWidth = 1280, kHeight = 720, kTrees = 50, kColumns = 10;
constexpr float kSpace = 9;  // m between trees

Result<model::Project> forest() {
  model::Project project;
  for (const char* name : {"Oak", "Birch", "Maple", "Fir", "Willow"}) {
    Result<model::Plant> plant = model::plantOfPreset(model::PresetLibrary(), QLatin1String(name), 1);
    if (!plant) return plant.error();
    plant->id = {project.nextId++};
    project.plants.push_back(std::move(*plant));
  }
  for (int i = 0; i < kTrees; ++i) {
    model::TreePlacement tree;
    tree.id = {project.nextId++};
    tree.plant = project.plants[static_cast<std::size_t>(i * 3 + i / kColumns) % project.plants.size()].id;
    const float x = kSpace * (static_cast<float>(i % kColumns) - 0.5f * (kColumns - 1));
    tree.position = {x + 1.5f * static_cast<float>(i % 3), 0, -kSpace * static_cast<float>(i / kColumns)};
    tree.heading = 73.0 * i;
    project.scene.trees.push_back(tree);
  }
  project.scene.leaves.count = 1'000'000;
  project.scene.leaves.season = 0;
  return project;
}

render::View viewFrom(const model::Scene& scene, float distance) {
  render::View view = widgets::sceneView({}, scene);
  view.eye = {4, 6 + 0.06f * distance, distance};
  view.target = {0, 5, -0.5f * kSpace * (kTrees / kColumns - 1)};
  view.width = kWidth;
  view.height = kHeight;
  return view;
}

QImage imageOf(const render::Picture& p) {
  return QImage(p.rgba.data(), p.width, p.height, p.width * 4, QImage::Format_RGBX8888).copy();
}

struct Stage {
  std::unique_ptr<render::OffscreenContext> context;
  std::unique_ptr<render::Renderer> renderer;

  Result<double> draw(const render::View& view, render::Picture* picture = nullptr) const {
    const auto begin = std::chrono::steady_clock::now();
    if (const Status drawn = renderer->draw(view, context->framebuffer()); !drawn) return drawn.error();
    render::Picture read = context->read();
    const double time = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    if (picture != nullptr) *picture = std::move(read);
    return time;
  }
};

/// Mean difference of a picture's blocks of 16 px from another's, in steps of 255.
double blockDifference(const render::Picture& a, const render::Picture& b) {
  constexpr int kBlock = 16;
  double sum = 0;
  int blocks = 0;
  for (int y = 0; y + kBlock <= a.height; y += kBlock) {
    for (int x = 0; x + kBlock <= a.width; x += kBlock, ++blocks) {
      double difference = 0;
      for (int py = y; py < y + kBlock; ++py) {
        for (int px = x; px < x + kBlock; ++px) {
          const auto at =
              (static_cast<std::size_t>(py) * static_cast<std::size_t>(a.width) + static_cast<std::size_t>(px)) * 4;
          for (std::size_t c = 0; c < 3; ++c) difference += double(a.rgba[at + c]) - double(b.rgba[at + c]);
        }
      }
      sum += std::abs(difference) / (3.0 * kBlock * kBlock);
    }
  }
  return blocks > 0 ? sum / blocks : 0;
}

}  // namespace

Result<std::vector<FoliageRow>> benchFoliage(int rounds, const std::string& folder,
                                             const std::function<void(const std::string&)>& say) {
  Result<model::Project> project = forest();
  if (!project) return project.error();
  model::Progress progress;
  const Result<model::SceneAssembly> assembly = model::assembleScene(*project, progress);
  if (!assembly) return assembly.error();
  const Result<std::unique_ptr<sim::Engine>> engine = sim::Engine::create(assembly->sim, sim::Device::Cpu);
  if (!engine) return engine.error();
  Stage stage;
  Result<std::unique_ptr<render::OffscreenContext>> context = render::OffscreenContext::create(kWidth, kHeight);
  if (!context) return context.error();
  Result<std::unique_ptr<render::Renderer>> renderer = render::Renderer::create();
  if (!renderer) return renderer.error();
  stage.context = std::move(*context);
  stage.renderer = std::move(*renderer);
  const render::SceneContent content = widgets::makeContent(*assembly, project->scene, (*engine)->leafCount());
  if (const Status set = stage.renderer->setContent(content); !set) return set.error();
  const render::FrameSlot slot = stage.renderer->acquire();
  (*engine)->write(slot.bones, slot.leaves);
  stage.renderer->publish(slot);
  char line[200];
  std::snprintf(line, sizeof line, "plant.foliage: %d trees, %zu leaves, %d x %d, %s", kTrees, (*engine)->leafCount(),
                kWidth, kHeight, stage.renderer->name().c_str());
  say(line);

  std::vector<FoliageRow> rows;
  for (const float distance : {60.0f, 120.0f, 240.0f, 480.0f}) {
    render::View views[2] = {viewFrom(project->scene, distance), viewFrom(project->scene, distance)};
    views[1].cardsBelow = 0;
    // What cards need is painted by a picture that is kept, then both contenders have warmed up.
    render::View kept = views[0];
    kept.quality = render::Quality::High;
    kept.cardsBelow *= 2;
    if (const Result<double> drawn = stage.draw(kept); !drawn) return drawn.error();
    render::View fine = kept;
    fine.cardsBelow = 0;
    render::Picture pictures[3];
    if (const Result<double> drawn = stage.draw(fine, &pictures[2]); !drawn) return drawn.error();
    std::vector<double> times[2];
    for (int round = 0; round <= rounds; ++round) {
      for (int k = 0; k < 2; ++k) {
        const Result<double> time = stage.draw(views[k], &pictures[k]);
        if (!time) return time.error();
        if (round > 0) times[k].push_back(*time);
      }
    }
    for (int k = 0; k < 2; ++k) {
      std::sort(times[k].begin(), times[k].end());
      rows.push_back({k == 0 ? "cards" : "every leaf", static_cast<double>(distance), times[k].front(),
                      times[k][times[k].size() / 2], blockDifference(pictures[k], pictures[2])});
      std::snprintf(line, sizeof line, "  %4.0f m  %-10s %8.1f ms (median %.1f), off the full picture by %.2f of 255",
                    rows.back().distance, rows.back().contender.c_str(), rows.back().least, rows.back().median,
                    rows.back().difference);
      say(line);
    }
    for (int k = 0; k < 3 && !folder.empty(); ++k) {
      const QDir dir(QString::fromStdString(folder));
      const QString name = QStringLiteral("foliage_%1_%2.png").arg(static_cast<int>(distance)).arg(k);
      if (!dir.mkpath(QStringLiteral(".")) || !imageOf(pictures[k]).save(dir.filePath(name))) {
        return Error{folder + ": cannot write " + name.toStdString()};
      }
    }
  }
  return rows;
}

std::string foliageJson(const FoliageRow& row) {
  char text[240];
  std::snprintf(text, sizeof text,
                R"({"contender": "%s", "distance": %.0f, "least": %.3f, "median": %.3f, "difference": %.4f})",
                row.contender.c_str(), row.distance, row.least, row.median, row.difference);
  return text;
}

}  // namespace windfall::app
