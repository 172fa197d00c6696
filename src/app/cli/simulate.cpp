#include <unistd.h>

#include <QFileInfo>
#include <cmath>
#include <cstdio>

#include "app/cli/commands.h"
#include "app/cli/interrupt.h"
#include "app/cli/simulate_bake.h"
#include "model/document/durable_file.h"
#include "model/document/project_file.h"
#include "model/plant/import.h"
#include "model/scene/assemble.h"
#include "model/scene/wind_csv.h"

namespace windfall::app {

namespace {

struct SimulateOptions {
  std::string file, device = "auto", method, trace, windData, bake;
  std::vector<float> direction;
  std::optional<float> wind, windUntil, dt;
  float spawnHeight = 0;
  double seconds = 20, bakeSeconds = 6;
  std::int32_t leaves = 0;
  int threads = 0;
  bool hash = false;
};

/// A project as it is, or a plant file alone on open ground.
Result<model::Project> openScene(const QString& path, model::Progress& progress) {
  if (!model::plantFilePatterns().contains("*." + QFileInfo(path).suffix().toLower())) {
    return model::readProject(path, progress);
  }
  Result<model::SourceFile> source = model::readSourceFile(path);
  if (!source) return source.error();
  model::Plant plant;
  plant.id = {1};
  plant.name = QFileInfo(path).completeBaseName();
  plant.file = std::move(*source);
  model::TreePlacement tree;
  tree.id = {2};
  tree.name = plant.name;
  tree.plant = plant.id;
  model::Project project;
  project.nextId = 3;
  project.plants.push_back(std::move(plant));
  project.scene.trees.push_back(std::move(tree));
  return project;
}

void apply(const SimulateOptions& options, model::Scene& scene) {
  if (options.wind) scene.wind.speed = *options.wind;
  if (options.windUntil) scene.wind.until = *options.windUntil;
  if (!options.direction.empty()) {
    scene.wind.direction = {options.direction[0], options.direction[1], options.direction[2]};
  }
  if (options.dt) scene.solver.step = *options.dt;
  if (const auto method = sim::treeMethodNamed(options.method)) scene.solver.method = *method;
  scene.leaves.count = options.leaves;
  scene.leaves.spawnHeight = options.spawnHeight;
}

/// The table of --trace, and what the last line says.
class Trace {
 public:
  explicit Trace(bool kept) : kept_(kept) {
    if (kept_) {
      rows_ =
          "time_s,tip_displacement_m,largest_angle_deg,kinetic_energy_J,elastic_energy_J,leaves_attached,"
          "leaves_in_the_air,leaves_on_the_ground\n";
    }
  }

  /// False when the simulation has left the numbers.
  bool add(const sim::Statistics& s) {
    const double angle = static_cast<double>(s.largestAngle) * 180 / 3.14159265358979;
    const double energy = s.kineticEnergy + s.elasticEnergy;
    if (!std::isfinite(angle) || !std::isfinite(energy) || !std::isfinite(s.tipDisplacement)) return false;
    largestAngle_ = std::max(largestAngle_, angle);
    peakEnergy_ = std::max(peakEnergy_, energy);
    lastEnergy_ = energy;
    tipSum_ += static_cast<double>(s.tipDisplacement);
    ++frames_;
    if (!kept_) return true;
    char row[256];
    std::snprintf(row, sizeof row, "%.6f,%.6g,%.6g,%.6g,%.6g,%d,%d,%d\n", s.time,
                  static_cast<double>(s.tipDisplacement), angle, s.kineticEnergy, s.elasticEnergy, s.attached,
                  s.airborne, s.grounded);
    rows_ += row;
    return true;
  }

  const QByteArray& rows() const { return rows_; }

  /// One line: how far, how fast, how much; what there was none of is left out.
  std::string summary(const sim::Statistics& last, const sim::SceneDescription& scene) const {
    char line[512];
    int length = std::snprintf(line, sizeof line, "%.6g s simulated", last.time);
    const auto append = [&](const char* format, auto... values) {
      const auto room = sizeof line - static_cast<std::size_t>(length);
      length += std::max(0, std::snprintf(line + length, room, format, values...));
    };
    if (!scene.trees.empty()) {
      append(", first frequency %.4f Hz", sim::firstFrequency(*scene.trees.front().tree));
      append(", largest angle %.2f degrees, mean tip displacement %.4g m", largestAngle_, tipSum_ / frames_);
      append(", peak energy %.4g J, energy at the end %.4g J", peakEnergy_, lastEnergy_);
    }
    if (last.landed > 0) {
      append(", mean fall time %.4f s of %lld leaves", last.fallTimeSum / static_cast<double>(last.landed),
             static_cast<long long>(last.landed));
    } else if (last.attached + last.airborne + last.grounded > 0) {
      append("%s", ", no leaf has landed");
    }
    return line;
  }

 private:
  bool kept_;
  QByteArray rows_;
  double largestAngle_ = 0, peakEnergy_ = 0, lastEnergy_ = 0, tipSum_ = 0;
  int frames_ = 0;
};

int run(const SimulateOptions& options) {
  const QString path = text(options.file), tracePath = text(options.trace);
  if (!tracePath.isEmpty() && !QFileInfo(QFileInfo(tracePath).absolutePath()).isDir()) {
    return fail(tracePath, QStringLiteral("its folder does not exist"));
  }
  InterruptProgress progress;
  Result<model::Project> project = openScene(path, progress);
  if (!project) return fail(path, project.error());
  apply(options, project->scene);
  if (!options.windData.empty()) {
    const float speed = project->scene.wind.speed;
    if (const Status read = model::readWindFile(text(options.windData), project->scene.wind); !read) {
      return fail(text(options.windData), read.error());
    }
    if (options.wind) project->scene.wind.speed = speed;
  }
  if (!options.bake.empty()) {
    return bakeInto(std::move(*project), path, text(options.bake), options.bakeSeconds, progress);
  }
  Result<model::SceneAssembly> assembly = model::assembleTrees(*project, progress);
  if (!assembly) return fail(path, assembly.error());
  const sim::Device device = options.device == "cuda"  ? sim::Device::Cuda
                             : options.device == "cpu" ? sim::Device::Cpu
                                                       : sim::Device::Auto;
  Result<std::unique_ptr<sim::Engine>> created = sim::Engine::create(assembly->sim, device, options.threads);
  if (!created) return fail(path, created.error());
  sim::Engine& engine = **created;

  // The step is single precision: 2 s are 100 steps of 0.02 s, not 101.
  const auto steps =
      static_cast<long long>(std::ceil(options.seconds / static_cast<double>(assembly->sim.solver.step) * (1 - 1e-6)));
  const bool terminal = isatty(STDERR_FILENO) != 0;
  Trace trace(!tracePath.isEmpty());
  bool sound = trace.add(engine.statistics());
  for (long long i = 0; i < steps && sound; ++i) {
    if (progress.cancelled()) return fail(path, Error{"cancelled", true});
    engine.step();
    sound = trace.add(engine.statistics());
    if (terminal && (i % 64 == 0 || i + 1 == steps)) {
      std::fprintf(stderr, "\r%3d %%%s", static_cast<int>(100 * (i + 1) / steps), i + 1 == steps ? "\r     \r" : "");
    }
  }
  if (!sound) {
    return fail(path, QStringLiteral("the simulation broke down after %1 s").arg(engine.statistics().time));
  }
  if (const std::string problem = engine.deviceProblem(); !problem.empty()) {
    std::fprintf(stderr, "windfall: %s\n", problem.c_str());
  }
  if (!tracePath.isEmpty()) {
    if (const Status written = model::writeDurably(tracePath, trace.rows()); !written) {
      return fail(tracePath, written.error());
    }
  }
  std::printf("%s\n", trace.summary(engine.statistics(), assembly->sim).c_str());
  if (options.hash) std::printf("state %016llx\n", static_cast<unsigned long long>(engine.hash()));
  return 0;
}

/// The wind needs a level direction.
std::string checkDirection(const std::vector<float>& direction) {
  if (direction.size() != 3) return "--direction: three numbers are needed, X,Y,Z";
  const float level = std::hypot(direction[0], direction[2]);
  return level > 1e-6f && std::isfinite(level + direction[1]) ? "" : "--direction: must not be vertical";
}

}  // namespace

void declareSimulate(CLI::App& app, Action& action) {
  CLI::App* command =
      app.add_subcommand("simulate", "Let the wind blow through a project or a plant, without a window");
  auto o = std::make_shared<SimulateOptions>();
  command->add_option("FILE", o->file, "Project (.windfall) or plant (.fbx, .glb, .gltf, .prim, .json)")->required();
  command->add_option("--seconds", o->seconds, "How long, in simulated seconds")
      ->check(CLI::Range(0.0, 1e6))
      ->capture_default_str();
  command->add_option("--dt", o->dt, "Length of a step in seconds (default: the project's, 1/60)")
      ->check(CLI::Range(1e-4, 10.0));
  command->add_option("--wind", o->wind, "Mean speed at 10 m height, in m/s")->check(CLI::Range(0.0, 100.0));
  command->add_option("--wind-data", o->windData,
                      "CSV table of time, speed and direction that the wind follows instead");
  command->add_option("--wind-until", o->windUntil, "Calm from this time on, in seconds")->check(CLI::Range(0.0, 1e9));
  command->add_option("--direction", o->direction, "Where it blows to; its level part counts")
      ->type_name("X,Y,Z")
      ->delimiter(',')
      ->expected(1, 3);
  command->add_option("--leaves", o->leaves, "How many leaves")
      ->check(CLI::Range(0, 100'000'000))
      ->capture_default_str();
  command->add_option("--spawn-height", o->spawnHeight, "Leaves start loose at this height, in m, not on the trees")
      ->check(CLI::Range(0.0, 1000.0));
  command->add_option("--device", o->device, "What computes")
      ->check(CLI::IsMember({"auto", "cpu", "cuda"}))
      ->capture_default_str();
  command->add_option("--threads", o->threads, "Threads on the CPU; 0: all")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  command
      ->add_option("--method", o->method,
                   "How joints are solved (default: the project's): coupled; analytic: each joint exact by itself; "
                   "forces, literal: the theses' methods, for comparison")
      ->check(CLI::IsMember({"coupled", "analytic", "forces", "literal"}));
  command->add_option("--trace", o->trace, "Write a row a step to this CSV file");
  command->add_option("--bake", o->bake,
                      "Write the first tree with a loopable clip of this wind instead (.glb, .gltf, .windfall)");
  command->add_option("--bake-seconds", o->bakeSeconds, "Length of that clip")
      ->check(CLI::Range(0.1, 120.0))
      ->capture_default_str();
  command->add_flag("--hash", o->hash, "Print the hash of the final state last");
  command->callback([o, &action] {
    if (const std::string problem = o->direction.empty() ? "" : checkDirection(o->direction); !problem.empty()) {
      throw CLI::ValidationError(problem);
    }
    action = [o] { return run(*o); };
  });
}

}  // namespace windfall::app
