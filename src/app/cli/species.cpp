// windfall species: the growers' presets as one sheet of pictures, summer and bare, whole and near.
#include <QFont>
#include <QImage>
#include <QPainter>
#include <QSaveFile>
#include <algorithm>
#include <cmath>
#include <optional>

#include "app/cli/commands.h"
#include "app/cli/interrupt.h"
#include "model/plant/grow/plant_presets.h"
#include "model/scene/assemble.h"
#include "sim/engine.h"
#include "widgets/render/offscreen_context.h"
#include "widgets/render/renderer.h"
#include "widgets/viewport/orbit_camera.h"
#include "widgets/viewport/scene_content.h"
#include "widgets/viewport/scene_view.h"

namespace windfall::app {

namespace {

struct SpeciesOptions {
  std::string output;
  std::vector<std::string> presets;
  int cell = 220, quality = 82;
  std::uint64_t seed = 1;
  double age = 1;  ///< share of maturity
};

/// A plant alone on the meadow, at rest in still air.
model::Project sceneOf(model::Plant plant, bool bare) {
  model::Project project;
  plant.id = {project.nextId++};
  plant.grower->foliage.leaves = plant.grower->foliage.leaves && !bare;
  model::TreePlacement tree;
  tree.id = {project.nextId++};
  tree.plant = plant.id;
  project.plants.push_back(std::move(plant));
  project.scene.trees.push_back(tree);
  project.scene.wind.speed = 0;
  project.scene.leaves.season = 0;
  project.scene.leaves.spawnHeight = 0;
  project.scene.light = {215, 38, 1};
  return project;
}

/// Where a plant is looked at: the whole of it, and from near by where its leaves begin, so that bark and leaves show.
struct Sight {
  widgets::Box box;
  double leavesFrom = 0;  ///< m above the ground
};

Sight sightOf(const model::SceneAssembly& assembly, const widgets::Box& box) {
  Sight sight{box, 0.25 * static_cast<double>(box.upper.y)};
  std::vector<float> heights;
  const sim::Tree& tree = *assembly.sim.trees.front().tree;
  for (const sim::LeafSite& site : tree.sites) {
    const sim::Link& link = tree.links[static_cast<std::size_t>(site.link)];
    heights.push_back((link.joint + link.rotation * site.position).y);
  }
  if (heights.size() < 4) return sight;
  const auto low = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 12);
  std::nth_element(heights.begin(), low, heights.end());
  sight.leavesFrom = static_cast<double>(*low);
  return sight;
}

model::Camera cameraAt(const Sight& sight, bool near, QSize size) {
  const widgets::Box& box = sight.box;
  const vec3 extent = box.upper - box.lower;
  const auto height = static_cast<double>(box.upper.y), across = static_cast<double>(std::max(extent.x, extent.z));
  model::Camera camera;
  camera.fieldOfView = 30;
  camera.azimuth = 12;
  const double half = std::tan(15 * 3.14159265 / 180), aspect = static_cast<double>(size.width()) / size.height();
  if (!near) {
    camera.elevation = 2;
    camera.distance = 0.54 * std::max(height, across / aspect) / half + 0.2 * across;
    camera.target = {0.5f * (box.lower.x + box.upper.x), static_cast<float>(0.47 * height),
                     0.5f * (box.lower.z + box.upper.z)};
    return camera;
  }
  const double reach = height > 4 ? std::clamp(0.15 * height, 1.2, 2.4) : 0.6 * height;
  camera.elevation = height > 4 ? 3 : 8;
  camera.distance = reach / half + 0.25 * std::min(across, 4.0);
  camera.target = {0, static_cast<float>(height > 4 ? std::max(sight.leavesFrom, 1.2) : 0.55 * height), 0};
  return camera;
}

class Studio {
 public:
  static Result<std::unique_ptr<Studio>> open(QSize size) {
    Result<std::unique_ptr<render::OffscreenContext>> context =
        render::OffscreenContext::create(size.width(), size.height());
    if (!context) return context.error();
    Result<std::unique_ptr<render::Renderer>> renderer = render::Renderer::create();
    if (!renderer) return renderer.error();
    auto studio = std::unique_ptr<Studio>(new Studio);
    studio->context_ = std::move(*context);
    studio->renderer_ = std::move(*renderer);
    studio->size_ = size;
    return studio;
  }

  /// Whole and near; `sight` is where the first of a plant's pictures looked.
  Result<std::vector<QImage>> shoot(const model::Project& project, std::optional<Sight>& sight,
                                    model::Progress& progress) {
    Result<model::SceneAssembly> assembly = model::assembleScene(project, progress);
    if (!assembly) return assembly.error();
    assembly->sim.leaves.count =
        static_cast<decltype(assembly->sim.leaves.count)>(assembly->sim.trees.front().tree->sites.size());
    Result<std::unique_ptr<sim::Engine>> engine = sim::Engine::create(assembly->sim, sim::Device::Cpu);
    if (!engine) return engine.error();
    if (const Status set =
            renderer_->setContent(widgets::makeContent(*assembly, project.scene, (*engine)->leafCount()));
        !set) {
      return set.error();
    }
    const std::optional<widgets::Box> box = widgets::sceneBox(*assembly, project.scene);
    if (!box) return Error{"has no mesh"};
    if (!sight) sight = sightOf(*assembly, *box);
    std::vector<QImage> pictures;
    for (const bool near : {false, true}) {
      render::View view = widgets::sceneView(cameraAt(*sight, near, size_), project.scene);
      view.width = size_.width(), view.height = size_.height();
      view.quality = render::Quality::High;
      const render::FrameSlot slot = renderer_->acquire();
      (*engine)->write(slot.bones, slot.leaves);
      renderer_->publish(slot);
      if (const Status drawn = renderer_->draw(view, context_->framebuffer()); !drawn) return drawn.error();
      const render::Picture picture = context_->read();
      pictures.push_back(
          QImage(picture.rgba.data(), picture.width, picture.height, picture.width * 4, QImage::Format_RGBX8888)
              .copy());
    }
    return pictures;
  }

 private:
  Studio() = default;
  std::unique_ptr<render::OffscreenContext> context_;
  std::unique_ptr<render::Renderer> renderer_;
  QSize size_;
};

int drawSpecies(const SpeciesOptions& options) {
  const QString output = text(options.output);
  const model::PresetLibrary library;
  std::vector<QString> names;
  for (const std::string& name : options.presets) names.push_back(text(name));
  if (names.empty()) {
    for (const model::Preset& preset : model::plantPresets(library)) names.push_back(preset.name);
  }
  const QSize cell(options.cell, options.cell * 6 / 5);
  InterruptProgress progress;
  // Twice as large and scaled down: smooth edges.
  Result<std::unique_ptr<Studio>> studio = Studio::open(cell * 2);
  if (!studio) return fail({}, studio.error());
  constexpr int kGap = 4, kLabel = 22, kColumns = 2;
  const int rows = (static_cast<int>(names.size()) + kColumns - 1) / kColumns,
            columns = std::min<int>(kColumns, static_cast<int>(names.size()));
  const QSize block(4 * (cell.width() + kGap) + kGap, cell.height() + kLabel + kGap);
  QImage sheet(block.width() * columns, block.height() * rows + kGap, QImage::Format_RGB32);
  sheet.fill(QColor(28, 30, 28));
  QPainter painter(&sheet);
  painter.setRenderHint(QPainter::Antialiasing);
  QFont font = painter.font();
  font.setPixelSize(14);
  painter.setFont(font);
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (progress.cancelled()) return fail({}, Error{"cancelled", true});
    Result<model::Plant> plant = model::plantOfPreset(library, names[i], options.seed);
    if (!plant) return fail({}, plant.error());
    plant->grower->age = options.age * plant->grower->maturity;
    const QPoint corner(static_cast<int>(i) % columns * block.width(), static_cast<int>(i) / columns * block.height());
    painter.setPen(QColor(222, 226, 216));
    painter.drawText(QRect(corner + QPoint(kGap + 2, 0), QSize(block.width(), kLabel)), Qt::AlignVCenter, plant->name);
    std::vector<QImage> pictures;
    std::optional<Sight> sight;
    for (const bool bare : {false, true}) {
      Result<std::vector<QImage>> shots = (*studio)->shoot(sceneOf(*plant, bare), sight, progress);
      if (!shots) return fail(plant->name, shots.error());
      pictures.insert(pictures.end(), shots->begin(), shots->end());
    }
    // Whole, whole bare, near, near bare.
    const std::size_t order[] = {0, 2, 1, 3};
    for (std::size_t k = 0; k < 4; ++k) {
      const QPoint place = corner + QPoint(kGap + static_cast<int>(k) * (cell.width() + kGap), kLabel);
      painter.drawImage(place, pictures[order[k]].scaled(cell, Qt::IgnoreAspectRatio, Qt::SmoothTransformation));
    }
  }
  painter.end();
  QSaveFile file(output);
  const QByteArray format = output.endsWith(QLatin1String(".png"), Qt::CaseInsensitive) ? "PNG" : "JPEG";
  if (!file.open(QIODevice::WriteOnly) ||
      !sheet.save(&file, format.constData(), format == "PNG" ? -1 : options.quality) || !file.commit()) {
    return fail(output, file.errorString());
  }
  return 0;
}

}  // namespace

void declareSpecies(CLI::App& app, Action& action) {
  CLI::App* command =
      app.add_subcommand("species", "Draw the growers' presets as one sheet: whole and near, in summer and bare");
  auto options = std::make_shared<SpeciesOptions>();
  command->add_option("-o,--output", options->output, "The picture (.jpg or .png)")->required();
  command->add_option("--preset", options->presets, "Only this one; may be given again");
  command->add_option("--cell", options->cell, "Width of a picture in pixels")
      ->check(CLI::Range(40, 2000))
      ->capture_default_str();
  command->add_option("--seed", options->seed, "Which plants of their kinds")->capture_default_str();
  command->add_option("--age", options->age, "Share of the age of maturity")
      ->check(CLI::Range(0.0, 2.0))
      ->capture_default_str();
  command->callback([options, &action] { action = [options] { return drawSpecies(*options); }; });
}

}  // namespace windfall::app
