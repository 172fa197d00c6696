#include "sim/engine.h"

#include <omp.h>

#include <cmath>

#include "sim/bodies.h"
#include "sim/cpu_engine.h"
#include "sim/cuda_engine.h"

namespace windfall::sim {

namespace {

constexpr int kMostSteps = 8;

std::string problemOf(const SceneDescription& scene) {
  const float h = scene.solver.step;
  if (!(h >= 1e-4f && h <= 10)) return "the step of the simulation must be between 0.0001 and 10 seconds";
  if (!(scene.solver.structuralDamping >= 0 && scene.solver.structuralDamping <= 10)) {
    return "the structural damping must be between 0 and 10";
  }
  std::size_t links = 0;
  for (const TreeInstance& instance : scene.trees) {
    if (!instance.tree) return "a tree of the scene is missing";
    std::string problem = problemOf(*instance.tree);
    if (!problem.empty()) return problem;
    const vec3& at = instance.placement.position;
    if (!(glm::dot(at, at) < 1e10f) || !std::isfinite(instance.placement.heading)) {
      return "the place of " + instance.tree->name + " is not a number";
    }
    links += instance.tree->links.size();
  }
  if (links > 0x7fffffffu) return "the scene has too many links";
  return {};
}

}  // namespace

namespace {
constexpr const char* kMethodNames[] = {"coupled", "analytic", "forces", "literal"};
}

const char* nameOf(TreeMethod method) { return kMethodNames[static_cast<int>(method)]; }

std::optional<TreeMethod> treeMethodNamed(std::string_view name) {
  for (int i = 0; i < 4; ++i) {
    if (name == kMethodNames[i]) return static_cast<TreeMethod>(i);
  }
  return {};
}

std::vector<DeviceInfo> devices() {
  const int threads = omp_get_max_threads();
  std::vector<DeviceInfo> all{
      {Device::Cpu, "CPU, " + std::to_string(threads) + (threads == 1 ? " thread" : " threads")}};
  if (const std::string name = cudaDeviceName(); !name.empty()) all.push_back({Device::Cuda, name});
  return all;
}

Result<std::unique_ptr<Engine>> Engine::create(SceneDescription scene, Device device, int threads) {
  if (std::string wrong = problemOf(scene); !wrong.empty()) return Error{std::move(wrong)};
  std::string problem;
  if (device != Device::Cpu) {
    if (std::unique_ptr<Engine> engine = makeCudaEngine(scene, threads, problem)) return engine;
    if (device == Device::Cuda) return Error{"no CUDA device: " + problem};
  }
  return std::unique_ptr<Engine>(std::make_unique<CpuEngine>(std::move(scene), threads));
}

Advance Engine::advance(double seconds) {
  Advance done;
  const double h = stepLength();
  if (!(seconds > 0)) return done;
  accumulator_ += seconds;
  // A sixtieth in single precision is no sixtieth: what rounding lacks to a step does not count.
  const double enough = h * (1 - 1e-6);
  while (accumulator_ >= enough && done.steps < kMostSteps) {
    accumulator_ = accumulator_ > h ? accumulator_ - h : 0;
    step();
    ++done.steps;
  }
  if (accumulator_ >= enough) {
    const double kept = std::fmod(accumulator_, h);
    done.lost = accumulator_ - kept;
    accumulator_ = kept;
  }
  between_ = accumulator_ / h;
  return done;
}

}  // namespace windfall::sim
