#include "widgets/viewport/detail_bench.h"

#include <QDir>
#include <QImage>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "model/plant/sample_skeleton.h"
#include "widgets/render/detail_stage.h"
#include "widgets/render/offscreen_context.h"
#include "widgets/viewport/detail_bench_scene.h"
#include "widgets/viewport/similarity.h"

namespace windfall::widgets {

namespace {

constexpr std::array kMeshes{BenchMesh::Uniform, BenchMesh::Bounded, BenchMesh::Adaptive};
constexpr std::array kNames{"uniform 16 x 8", "error bound at 1 m", "adaptive"};
constexpr float kFieldOfView = 0.7f;
constexpr float kTolerance = 0.35f;  // px
constexpr float kMoved = 0.1f;       // px: what a reader of pictures cannot see

struct Path {
  const char* name;
  float from, to;  ///< m before the first row
};

/// Turned to the side by `moved` px.
render::View viewAt(const Path& path, int frame, int frames, float moved = 0, float scale = 1) {
  const float share = frames > 1 ? static_cast<float>(frame) / static_cast<float>(frames - 1) : 0;
  const float distance = path.from + (path.to - path.from) * share;
  render::View view;
  view.eye = {0.3f, 0.55f + 0.03f * distance, distance};
  view.target = {0.0f, 0.42f, 0.0f};
  view.fieldOfView = kFieldOfView;
  view.tolerance = kTolerance;
  view.target.x += moved / scale * distance;
  return view;
}

double barkPixels(const render::Picture& picture) {
  double count = 0;
  for (std::size_t i = 3; i < picture.rgba.size(); i += 4) count += picture.rgba[i] / 255.0;
  return count;
}

std::size_t drawnVertices(const BenchScene& scene, BenchMesh mesh, bool triangles) {
  std::size_t count = 0;
  for (int i = 0; i < scene.trees; ++i) {
    const BenchPlant& plant = scene.plants[static_cast<std::size_t>(i) % scene.plants.size()];
    const render::Mesh& drawn = mesh == BenchMesh::Uniform ? plant.uniform : plant.bounded;
    count += triangles ? drawn.indices.size() / 3 : drawn.vertices.size();
  }
  return count;
}

/// A mesh that is ready to be drawn, and what its frames gave.
struct Runner {
  std::unique_ptr<render::DetailStage> stage;
  std::vector<double> times;
  std::vector<render::Picture> pictures;  ///< with the window's samples
  std::vector<render::Picture> fine;      ///< with four times as many
  double vertices = 0, triangles = 0;
};

/// A picture of half the size, each pixel the mean of four.
render::Picture halved(const render::Picture& from) {
  render::Picture to{from.width / 2, from.height / 2, {}};
  const auto row = static_cast<std::size_t>(from.width) * 4;
  to.rgba.reserve(from.rgba.size() / 4);
  for (int y = 0; y < to.height; ++y) {
    const std::uint8_t* upper = from.rgba.data() + row * 2 * static_cast<std::size_t>(y);
    for (std::size_t x = 0; x < static_cast<std::size_t>(to.width) * 8; x += 8) {
      for (std::size_t c = x; c < x + 4; ++c) {
        to.rgba.push_back(
            static_cast<std::uint8_t>((upper[c] + upper[c + 4] + upper[row + c] + upper[row + c + 4] + 2) / 4));
      }
    }
  }
  return to;
}

double meanSimilarity(const std::vector<render::Picture>& a, const std::vector<render::Picture>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += similarity(a[i], b[i]) / static_cast<double>(a.size());
  return sum;
}

Status keepPictures(const std::string& folder, const Path& path, int mesh, const Runner& runner) {
  const QDir dir(QString::fromStdString(folder));
  if (!dir.mkpath(QStringLiteral("."))) return Error{folder + ": cannot make this folder"};
  for (std::size_t i = 0; i < runner.pictures.size(); ++i) {
    const render::Picture& p = runner.pictures[i];
    const QImage image(p.rgba.data(), p.width, p.height, p.width * 4, QImage::Format_RGBA8888);
    const QString name = QStringLiteral("%1_%2_%3.png").arg(path.name).arg(mesh).arg(i, 2, 10, QLatin1Char('0'));
    if (!image.save(dir.filePath(name))) return Error{folder + ": cannot write " + name.toStdString()};
  }
  return ok();
}

DetailBenchRow rowOf(const Path& path, const char* name, const Runner& runner, const Runner& finest) {
  DetailBenchRow row;
  row.path = path.name;
  row.mesh = name;
  const auto frames = static_cast<double>(runner.times.size());
  row.ssim = meanSimilarity(runner.fine, finest.fine);
  row.windowSsim = meanSimilarity(runner.pictures, finest.pictures);
  double pixels = 0, all = 0;
  for (std::size_t i = 0; i < runner.times.size(); ++i) {
    row.mean += runner.times[i] / frames;
    row.worst = std::max(row.worst, runner.times[i]);
    pixels += barkPixels(runner.pictures[i]);
    all += barkPixels(finest.pictures[i]);
  }
  row.bark = all > 0 ? pixels / all : 0;
  row.vertices = runner.vertices / frames;
  row.triangles = runner.triangles / frames;
  return row;
}

/// The adaptive mesh's figures on a path, each beside what is wanted of it.
std::string verdict(const DetailBenchRow& uniform, const DetailBenchRow& bounded, const DetailBenchRow& adaptive) {
  const bool near = adaptive.path == "near";
  std::string text = "  " + adaptive.path + " wanted:";
  const auto add = [&](const char* what, double value, const char* wanted, bool met) {
    char part[120];
    std::snprintf(part, sizeof part, "  %s %.3g (%s%s)", what, value, wanted, met ? "" : ", MISSED");
    text += part;
  };
  const double speed = uniform.mean / adaptive.mean, share = bounded.mean / adaptive.mean;
  const double vertices = uniform.vertices / std::max(adaptive.vertices, 1.0);
  add("times uniform's speed", speed, ">= 10", speed >= 10);
  add("uniform's vertices over its own", vertices, ">= 20", vertices >= 20);
  if (near) {
    add("bounded's time over its own", share, ">= 0.909", share >= 1 / 1.1);
  } else {
    add("bounded's time over its own", share, ">= 1.4", share >= 1.4);
  }
  add("worst frame over bounded's", adaptive.worst / bounded.worst, "<= 1", adaptive.worst <= bounded.worst);
  const bool bark = near ? adaptive.bark >= 0.97 && adaptive.bark <= 1.03 : adaptive.bark >= 0.95;
  add("bark", adaptive.bark, near ? "0.97 to 1.03" : ">= 0.95", bark);
  add("SSIM", adaptive.ssim, ">= 0.98", adaptive.ssim >= 0.98);
  return text;
}

}  // namespace

Result<std::vector<DetailBenchRow>> benchDetail(const DetailBenchOptions& options,
                                                const std::function<void(const std::string&)>& say) {
  auto context = render::OffscreenContext::create(16, 16);
  if (!context) return context.error();
  BenchScene scene;
  scene.trees = options.plants;
  const float focal = static_cast<float>(options.height) / (2 * std::tan(kFieldOfView / 2));
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    scene.plants.push_back(makeBenchPlant(model::sampleSkeleton(seed), 0.5f / focal));
  }
  std::array<Runner, 3> runners;
  for (std::size_t m = 0; m < kMeshes.size(); ++m) {
    auto stage = render::DetailStage::create(options.width, options.height);
    if (!stage) return stage.error();
    if (const Status set = (*stage)->setContent(scene.content(kMeshes[m])); !set) return set.error();
    runners[m].stage = std::move(*stage);
  }
  std::vector<DetailBenchRow> rows;
  // Pictures of twice the size, halved: 16 samples a pixel.
  auto large = render::DetailStage::create(2 * options.width, 2 * options.height);
  if (!large) return large.error();
  const auto photograph = [&](const Path& path, BenchMesh mesh, float moved) -> Result<std::vector<render::Picture>> {
    if (const Status set = (*large)->setContent(scene.content(mesh)); !set) return set.error();
    std::vector<render::Picture> pictures;
    for (int frame = 0; frame < options.frames; ++frame) {
      render::View view = viewAt(path, frame, options.frames, moved, focal);
      view.tolerance *= 2;
      (*large)->draw(view, scene.pose(static_cast<float>(frame) / 24), mesh == BenchMesh::Adaptive, true);
      pictures.push_back(halved((*large)->read()));
    }
    return pictures;
  };
  for (const Path& path : {Path{"near", 9, 1}, Path{"far", 40, 15}}) {
    for (Runner& runner : runners) {
      runner.times.assign(static_cast<std::size_t>(options.frames), 1e9);
      runner.pictures.assign(runner.times.size(), {});
      runner.vertices = runner.triangles = 0;
    }
    // The first round gives the pictures, in the renderer's quality; it compiles shaders and does not count.
    for (int round = 0; round <= options.rounds; ++round) {
      for (int frame = 0; frame < options.frames; ++frame) {
        const auto bones = scene.pose(static_cast<float>(frame) / 24);
        const render::View view = viewAt(path, frame, options.frames);
        for (std::size_t m = 0; m < kMeshes.size(); ++m) {
          Runner& runner = runners[m];
          const bool adaptive = kMeshes[m] == BenchMesh::Adaptive;
          const double time = runner.stage->draw(view, bones, adaptive, round == 0);
          double& least = runner.times[static_cast<std::size_t>(frame)];
          if (round > 0) least = std::min(least, time);
          if (round > 0) continue;
          runner.pictures[static_cast<std::size_t>(frame)] = runner.stage->read();
          const render::DetailCounts counts = runner.stage->counts();
          runner.vertices += static_cast<double>(adaptive ? counts.vertices : drawnVertices(scene, kMeshes[m], false));
          runner.triangles += static_cast<double>(adaptive ? counts.triangles : drawnVertices(scene, kMeshes[m], true));
        }
      }
    }
    Runner moved;
    for (int frame = 0; frame < options.frames; ++frame) {
      render::DetailStage& stage = *runners[0].stage;
      stage.draw(viewAt(path, frame, options.frames, kMoved, focal), scene.pose(static_cast<float>(frame) / 24), false,
                 true);
      moved.pictures.push_back(stage.read());
    }
    for (std::size_t m = 0; m < kMeshes.size(); ++m) {
      auto fine = photograph(path, kMeshes[m], 0);
      if (!fine) return fine.error();
      runners[m].fine = std::move(*fine);
    }
    auto fine = photograph(path, BenchMesh::Uniform, kMoved);
    if (!fine) return fine.error();
    moved.fine = std::move(*fine);
    for (std::size_t m = 0; m < kMeshes.size(); ++m) {
      if (!options.pictures.empty()) {
        const Status kept = keepPictures(options.pictures, path, static_cast<int>(m), runners[m]);
        if (!kept) return kept.error();
      }
      rows.push_back(rowOf(path, kNames[m], runners[m], runners[0]));
      const DetailBenchRow& row = rows.back();
      const DetailBenchRow& first = rows[rows.size() - 1 - m];
      char line[240];
      std::snprintf(
          line, sizeof line,
          "  %-5s %-19s %8.2f ms  worst %8.2f  %9.0f vertices %9.0f triangles  bark %.3f  SSIM %.4f, with the "
          "window's samples %.4f  %.1f x",
          row.path.c_str(), row.mesh.c_str(), row.mean, row.worst, row.vertices, row.triangles, row.bark, row.ssim,
          row.windowSsim, first.mean / row.mean);
      say(line);
    }
    char line[200];
    std::snprintf(
        line, sizeof line,
        "  %-5s the uniform mesh against itself, turned by %.1f px: SSIM %.4f, with the window's samples %.4f",
        path.name, static_cast<double>(kMoved), meanSimilarity(moved.fine, runners[0].fine),
        meanSimilarity(moved.pictures, runners[0].pictures));
    say(line);
    say(verdict(rows[rows.size() - 3], rows[rows.size() - 2], rows.back()));
  }
  for (Runner& runner : runners) runner.stage.reset();
  return rows;
}

std::string detailJson(const DetailBenchRow& row) {
  char text[400];
  std::snprintf(
      text, sizeof text,
      R"({"path": "%s", "mesh": "%s", "milliseconds": %.4g, "worst": %.4g, "vertices": %.0f, "triangles": %.0f, )"
      R"("bark": %.5f, "ssim": %.5f, "windowSsim": %.5f})",
      row.path.c_str(), row.mesh.c_str(), row.mean, row.worst, row.vertices, row.triangles, row.bark, row.ssim,
      row.windowSsim);
  return text;
}

}  // namespace windfall::widgets
