#include "sim/tree_bench.h"

#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <numbers>

#include "sim/articulated.h"
#include "sim/engine.h"
#include "sim/sample_tree.h"
#include "sim/tree_field.h"
#include "sim/wind.h"

namespace windfall::sim {

namespace {

constexpr double kFrequency = 0.5;  // Hz: the search for it would take longer than the benchmark of a million links

struct Scene {
  std::shared_ptr<const Tree> tree;
  WindField wind{vec3(-8, 0, -8), vec3(8, 12, 8), WindSettings{.speed = 8}, 1};
  int repeats = 1;
  explicit Scene(const SampleTreeSettings& settings) : tree(std::make_shared<Tree>(sampleTree(settings))) {
    wind.advance(0);
    repeats = static_cast<int>(std::clamp<std::size_t>(400'000 / tree->links.size(), 1, 60));
  }
};

std::shared_ptr<TreeField> fieldOf(const Scene& scene, TreeMethod method, int threads) {
  FactorSettings settings;
  settings.method = method;
  settings.windSpeed = 8;
  settings.frequency = kFrequency;
  return std::make_shared<TreeField>(std::vector<TreeInstance>{{scene.tree, {}}}, settings, threads);
}

std::string threadsOf(int threads) { return std::to_string(threads) + (threads == 1 ? " thread" : " threads"); }

/// A step in air that has been sampled before.
Contender solve(const std::shared_ptr<Scene>& scene, TreeMethod method, int threads) {
  const std::shared_ptr<TreeField> field = fieldOf(*scene, method, threads);
  Contender contender;
  contender.name = std::string(nameOf(method)) + ", solve and poses, " + threadsOf(threads);
  contender.items = static_cast<double>(field->size());
  contender.repeats = scene->repeats;
  const double bytes = static_cast<double>(field->bytes());
  char note[96];
  std::snprintf(note, sizeof note, "%.0f bytes a link, %.1f MB", bytes / contender.items, bytes / 1e6);
  contender.note = note;
  field->sampleAir(scene->wind.view());
  contender.run = [scene, field] { field->solve(); };
  return contender;
}

/// The air at every link, which a step needs besides.
Contender air(const std::shared_ptr<Scene>& scene) {
  const std::shared_ptr<TreeField> field = fieldOf(*scene, TreeMethod::Analytic, 1);
  Contender contender;
  contender.name = "the wind at every link, 1 thread";
  contender.items = static_cast<double>(field->size());
  contender.repeats = scene->repeats;
  contender.run = [scene, field] { field->sampleAir(scene->wind.view()); };
  return contender;
}

/// Both: what a scene waits for. The share of the wind is what this takes beyond the solver.
Contender whole(const std::shared_ptr<Scene>& scene) {
  const std::shared_ptr<TreeField> field = fieldOf(*scene, TreeMethod::Coupled, 1);
  Contender contender;
  contender.name = "coupled, wind, solve and poses, 1 thread";
  contender.items = static_cast<double>(field->size());
  contender.repeats = scene->repeats;
  contender.run = [scene, field] { field->step(scene->wind.view()); };
  return contender;
}

/// The same loads and the same implicit springs, factored anew in each step's pose: what a general engine does.
Contender articulated(const std::shared_ptr<Scene>& scene) {
  using Reference = ArticulatedTree<float>;
  const std::vector<LinkBody> bodies = bodiesOf(*scene->tree);
  const double beta = 2 * 0.03 / (2 * std::numbers::pi * kFrequency);
  auto tree = std::make_shared<Reference>(bodies, static_cast<float>(beta));
  const std::vector<Composite> composites = compositesOf(bodies);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    Reference::Part& part = tree->parts()[i];
    part.rotor.z = static_cast<float>(twistFloor(bodies[i], composites[i]));
    const glm::dvec3 weight(0, -9.81, 0);
    part.preStress = vec3(glm::transpose(bodies[i].axes) * glm::cross(composites[i].moment, weight));
    part.force = vec3(0, -9.81f * part.mass, 0);
  }
  Contender contender;
  contender.name = "articulated bodies anew each step, 1 thread";
  contender.items = static_cast<double>(bodies.size());
  contender.repeats = scene->repeats;
  contender.run = [tree] { tree->stepImplicit(1.f / 60); };
  return contender;
}

std::vector<Contender> stepContenders(const SampleTreeSettings& settings, bool peer) {
  auto scene = std::make_shared<Scene>(settings);
  std::vector<Contender> all{solve(scene, TreeMethod::Coupled, 1), solve(scene, TreeMethod::Analytic, 1)};
  if (const int threads = omp_get_max_threads(); threads > 1) {
    all.push_back(solve(scene, TreeMethod::Coupled, threads));
    all.push_back(solve(scene, TreeMethod::Analytic, threads));
  }
  all.push_back(air(scene));
  all.push_back(whole(scene));
  if (peer) all.push_back(articulated(scene));
  return all;
}

/// What the live window waits for at 10,000 links: the engine's own timers, through whole steps.
std::vector<Contender> liveContenders() {
  SceneDescription scene;
  SampleTreeSettings settings = tenThousandLinks();
  settings.sitesPerLink = 0;
  scene.trees.push_back({std::make_shared<Tree>(sampleTree(settings)), {}});
  scene.leaves.count = 0;
  scene.wind.speed = 8;
  Result<std::unique_ptr<Engine>> created = Engine::create(scene, Device::Cpu, 1);
  const std::shared_ptr<Engine> engine = std::move(*created);
  auto bones = std::make_shared<std::vector<mat4>>(engine->linkCount());
  Contender whole{"wind, solve and poses, 1 thread", nullptr, 1};
  whole.repeats = 200;
  whole.run = [engine] { engine->step(); };
  Contender shown{"bone matrices for the display, 1 thread", nullptr, 1};
  shown.repeats = 200;
  shown.run = [engine, bones] { engine->write(*bones, {}); };
  return {whole, shown};
}

/// Steps of a wind that goes from a breath to a storm and back every eight seconds, so that the constants which depend
/// on its level are made anew each second.
std::vector<Contender> gustContenders(const SampleTreeSettings& sample, double seconds) {
  const auto scene = std::make_shared<Scene>(sample);
  WindSettings gusts{.speed = 15};
  gusts.course = WindCourse::Curve;
  gusts.curve = {{0, 0.07f, 0}, {4, 2, 0}, {8, 0.07f, 0}};
  const auto minute = [scene, gusts, seconds](const std::string& name, int threads, bool atOnce) {
    const std::shared_ptr<TreeField> field = fieldOf(*scene, TreeMethod::Coupled, threads);
    const auto wind = std::make_shared<WindField>(vec3(-8, 0, -8), vec3(8, 12, 8), gusts, threads);
    Contender contender{name + ", " + threadsOf(threads), nullptr};
    contender.profile = [field, wind, seconds, atOnce] {
      FactorSettings settings = field->settings();
      settings.windSpeed = static_cast<double>(wind->level(0));
      field->factorise(settings);
      field->reset();
      wind->restore({});
      std::vector<double> times;
      for (int i = 0; i < static_cast<int>(60 * seconds); ++i) {
        const auto start = std::chrono::steady_clock::now();
        settings.windSpeed = static_cast<double>(wind->level(i / 60.0));
        if (settings.windSpeed != field->settings().windSpeed) {
          if (atOnce) {
            field->factorise(settings);
          } else {
            field->renew(settings, field->lostArea());
          }
        }
        wind->advance((i + 0.5) / 60);
        field->step(wind->view());
        times.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
      }
      return times;
    };
    return contender;
  };
  std::vector<Contender> all{minute("constants beside the steps", 1, false)};
  if (const int threads = omp_get_max_threads(); threads > 1) {
    all.push_back(minute("constants beside the steps", threads, false));
  }
  all.push_back(minute("constants in one step (baseline)", 1, true));
  return all;
}

std::vector<Contender> windContenders() {
  auto field = std::make_shared<WindField>(vec3(-8, 0, -8), vec3(8, 12, 8), WindSettings{}, 1);
  auto time = std::make_shared<double>(0);
  const WindView view = field->view();
  const double nodes = static_cast<double>(view.nx) * view.ny * view.nz;
  Contender spread{"evaluated at 8 Hz, interpolated between", nullptr, nodes * 60};
  spread.run = [field, time] {
    for (int i = 0; i < 60; ++i) field->advance(*time += 1.0 / 60);
  };
  auto sum = std::make_shared<vec3>(0);
  const auto everywhere = [view](const auto& visit) {
    for (int z = 0; z < view.nz; ++z) {
      for (int y = 0; y < view.ny; ++y) {
        for (int x = 0; x < view.nx; ++x) visit(view.origin + vec3(x, y, z) / view.perMetre);
      }
    }
  };
  Contender direct{"evaluated each step", nullptr, nodes};
  direct.run = [field, sum, everywhere] {
    const WindMoment moment = field->moment(1);
    everywhere([&](const vec3& place) { *sum += vec3(windNode(moment, place, windProfile(place.y))); });
  };
  Contender lookup{"what a link asks for: lattice and small eddies", nullptr, nodes};
  lookup.run = [field, sum, everywhere] {
    const WindView now = field->view();
    everywhere([&](const vec3& place) { *sum += windAt(now, place + vec3(0.4f)); });
  };
  Contender tile{"a lookup in the tile of eddies", nullptr, nodes};
  tile.run = [field, sum, everywhere] {
    const WindView now = field->view();
    everywhere([&](const vec3& place) { *sum += eddyAt(now.eddies, place * 2.f); });
  };
  return {spread, direct, lookup, tile};
}

std::vector<Contender> factorContenders() {
  const Scene scene(tenThousandLinks());
  std::vector<Contender> all;
  for (const TreeMethod method : {TreeMethod::Coupled, TreeMethod::Analytic}) {
    const std::shared_ptr<TreeField> field = fieldOf(scene, method, 1);
    Contender contender{nameOf(method), nullptr, static_cast<double>(field->size())};
    contender.run = [field] { field->factorise(field->settings()); };
    all.push_back(std::move(contender));
  }
  return all;
}

}  // namespace

std::vector<Benchmark> treeBenchmarks() {
  const auto step = [](const char* name, const char* what, const SampleTreeSettings& settings, bool peer) {
    return Benchmark{name, what, "ns per link and step", 1e9, [=] { return stepContenders(settings, peer); }};
  };
  return {step("tree-1k", "a step of a broadleaf of 1,174 links", broadleafOf(1'000), true),
          step("tree-10k", "a step of a broadleaf of 9,562 links", broadleafOf(10'000), true),
          step("tree-100k", "a step of a broadleaf of 99,680 links", broadleafOf(100'000), false),
          step("tree-1m", "a step of a broadleaf of 1,009,076 links", broadleafOf(1'000'000), false),
          step("tree-conifer-10k", "a step of a conifer of 9,600 links, 313 deep", coniferOf(10'000), false),
          step("tree-conifer-100k", "a step of a conifer of 100,800 links, 313 deep", coniferOf(100'000), false),
          step("tree-conifer-1m", "a step of a conifer of 996,300 links, 313 deep", coniferOf(1'000'000), false),
          {"tree-gusts-10k", "steps of a gusty minute, wind, constants and all, of 9,562 links", "ms per step", 1e3,
           [] { return gustContenders(broadleafOf(10'000), 60); }},
          {"tree-gusts-100k", "steps of ten gusty seconds, wind, constants and all, of 99,680 links", "ms per step",
           1e3, [] { return gustContenders(broadleafOf(100'000), 10); }},
          {"tree-live", "a step of the live window with 9,562 links", "ms per step", 1e3, liveContenders},
          {"wind", "the wind around a tree, brought to the next step", "ns per place and step", 1e9, windContenders},
          {"tree-factor", "new stiffness or wind level of a broadleaf of 9,562 links", "ns per link", 1e9,
           factorContenders}};
}

}  // namespace windfall::sim
