// windfall render: a project's scene as pictures, without a window.
#include <unistd.h>

#include <QDir>
#include <QFileInfo>
#include <QImage>
#include <QSaveFile>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/cli/commands.h"
#include "app/cli/interrupt.h"
#include "model/document/project_file.h"
#include "model/scene/assemble.h"
#include "sim/engine.h"
#include "widgets/render/offscreen_context.h"
#include "widgets/render/renderer.h"
#include "widgets/viewport/orbit_camera.h"
#include "widgets/viewport/scene_content.h"
#include "widgets/viewport/scene_view.h"

namespace windfall::app {

namespace {

struct RenderOptions {
  std::string project, output, frames, size = "1280x720", quality = "high";
  double fps = 24;
};

struct FrameRange {
  int first = 1, last = 1;
};

/// "A-B" or "A", counted from 1.
std::optional<FrameRange> parseFrames(const QString& text) {
  const QStringList parts = text.split('-');
  bool goodFirst = false, goodLast = false;
  FrameRange range;
  range.first = parts.value(0).toInt(&goodFirst);
  range.last = parts.value(parts.size() - 1).toInt(&goodLast);
  if (parts.size() > 2 || !goodFirst || !goodLast || range.first < 1 || range.last < range.first) return std::nullopt;
  return range;
}

std::optional<QSize> parseSize(const QString& text) {
  const QStringList parts = text.toLower().split('x');
  if (parts.size() != 2) return std::nullopt;
  const QSize size(parts[0].toInt(), parts[1].toInt());
  if (size.width() < 16 || size.height() < 16 || size.width() > 16384 || size.height() > 16384) return std::nullopt;
  return size;
}

/// Whole or not at all: a temporary file beside it, renamed at the end.
Status writePng(const render::Picture& picture, const QString& path) {
  const QImage image(picture.rgba.data(), picture.width, picture.height, picture.width * 4, QImage::Format_RGBX8888);
  QSaveFile file(path);
  if (!file.open(QIODevice::WriteOnly) || !image.convertToFormat(QImage::Format_RGB888).save(&file, "PNG") ||
      !file.commit()) {
    return Error{"cannot write the picture: " + file.errorString().toStdString()};
  }
  return ok();
}

/// One line on a terminal, written over by the next.
class FrameCounter {
 public:
  explicit FrameCounter(int count) : count_(count), terminal_(isatty(STDERR_FILENO) != 0) {}
  ~FrameCounter() {
    if (terminal_ && said_) std::fprintf(stderr, "\r\033[K");
  }
  void say(int done) {
    if (!terminal_) return;
    std::fprintf(stderr, "\rframe %d of %d", done, count_);
    said_ = true;
  }

 private:
  int count_;
  bool terminal_, said_ = false;
};

/// The project's camera, or one that shows all trees where nobody has moved it yet.
model::Camera cameraFor(const model::Project& project, const model::SceneAssembly& assembly, const QSize& size) {
  if (project.view.camera != model::Camera() || assembly.trees.empty()) return project.view.camera;
  widgets::OrbitCamera camera(project.view.camera);
  if (const std::optional<widgets::Box> box = widgets::sceneBox(assembly, project.scene)) camera.frame(*box, size);
  // From low down the tree stands against the sky, and fills the picture.
  model::Camera framed = camera.state();
  framed.elevation = 4;
  framed.distance *= 0.75;
  return framed;
}

/// Simulates `seconds` however long; a call of the engine drops what exceeds eight steps.
void simulate(sim::Engine& engine, double seconds, double step) {
  const int parts = std::max(1, static_cast<int>(std::ceil(seconds / (4 * step))));
  for (int i = 0; i < parts; ++i) engine.advance(seconds / parts);
}

int renderProject(const RenderOptions& options) {
  const QString path = text(options.project), output = text(options.output);
  const bool single = output.endsWith(QLatin1String(".png"), Qt::CaseInsensitive);
  const auto range = parseFrames(options.frames.empty() ? QStringLiteral("1") : text(options.frames));
  const auto size = parseSize(text(options.size));
  if (!range || !size || !(options.fps > 0 && options.fps <= 1000)) {
    fail({}, !range  ? QStringLiteral("--frames wants A-B, counted from 1")
             : !size ? QStringLiteral("--size wants WIDTHxHEIGHT in pixels, 16 to 16384")
                     : QStringLiteral("--fps wants a number above 0"));
    return 2;
  }
  if (single && range->first != range->last) {
    fail({}, QStringLiteral("several frames need a folder: -o DIR"));
    return 2;
  }
  if (!single && QFileInfo(output).suffix().compare(QLatin1String("mp4"), Qt::CaseInsensitive) == 0) {
    fail(output, QStringLiteral("films cannot be written yet; give a folder for PNG frames"));
    return 2;
  }

  InterruptProgress progress;
  Result<model::Project> project = model::readProject(path, progress);
  if (!project) return fail(path, project.error());
  Result<model::SceneAssembly> assembly = model::assembleScene(*project, progress);
  if (!assembly) return fail(path, assembly.error());
  Result<std::unique_ptr<sim::Engine>> engine = sim::Engine::create(assembly->sim, sim::Device::Auto);
  if (!engine) return fail(path, engine.error());
  if (!project->simulation.bytes.isEmpty()) {
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(project->simulation.bytes.constData());
    const Status restored = (*engine)->restore({bytes, static_cast<std::size_t>(project->simulation.bytes.size())});
    if (!restored) fail(path, QStringLiteral("starts from rest: ") + text(restored.error().message));
  }

  Result<std::unique_ptr<render::OffscreenContext>> context =
      render::OffscreenContext::create(size->width(), size->height());
  if (!context) return fail({}, context.error());
  Result<std::unique_ptr<render::Renderer>> renderer = render::Renderer::create();
  if (!renderer) return fail({}, renderer.error());
  if (const Status set =
          (*renderer)->setContent(widgets::makeContent(*assembly, project->scene, (*engine)->leafCount()));
      !set) {
    return fail(path, set.error());
  }
  if (!single && !QDir().mkpath(output)) return fail(output, QStringLiteral("cannot make this folder"));

  render::View view = widgets::sceneView(cameraFor(*project, *assembly, *size), project->scene);
  view.width = size->width();
  view.height = size->height();
  view.quality = options.quality == "draft"      ? render::Quality::Draft
                 : options.quality == "standard" ? render::Quality::Standard
                                                 : render::Quality::High;
  FrameCounter counter(range->last - range->first + 1);
  for (int frame = 1; frame <= range->last; ++frame) {
    if (progress.cancelled()) return fail(path, Error{"cancelled", true});
    if (frame > 1) simulate(**engine, 1 / options.fps, project->scene.solver.step);
    if (frame < range->first) continue;
    counter.say(frame - range->first + 1);
    const render::FrameSlot slot = (*renderer)->acquire();
    (*engine)->write(slot.bones, slot.leaves);
    (*renderer)->publish(slot);
    view.time = static_cast<float>((*engine)->time());
    if (const Status drawn = (*renderer)->draw(view, (*context)->framebuffer()); !drawn)
      return fail(path, drawn.error());
    const QString file =
        single ? output : QDir(output).filePath(QStringLiteral("frame_%1.png").arg(frame, 4, 10, QLatin1Char('0')));
    if (const Status written = writePng((*context)->read(), file); !written) return fail(file, written.error());
  }
  if (const std::string problem = (*engine)->deviceProblem(); !problem.empty()) fail({}, text(problem));
  return 0;
}

}  // namespace

void declareRender(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("render", "Draw a project's scene into PNG pictures, frame by frame");
  auto options = std::make_shared<RenderOptions>();
  command->add_option("PROJECT", options->project, "The project")->required();
  command->add_option("-o,--output", options->output, "A folder for frame_0001.png and on, or one FILE.png")
      ->required();
  command->add_option("--frames", options->frames, "Frames A-B, counted from 1; those before A are simulated only");
  command->add_option("--fps", options->fps, "Frames a second")->capture_default_str();
  command->add_option("--size", options->size, "WIDTHxHEIGHT in pixels")->capture_default_str();
  command->add_option("--quality", options->quality, "draft, standard or high")
      ->check(CLI::IsMember({"draft", "standard", "high"}))
      ->capture_default_str();
  command->callback([options, &action] { action = [options] { return renderProject(*options); }; });
}

}  // namespace windfall::app
