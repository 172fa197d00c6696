// A step takes no memory: counted by operators new of this program's own and, where no sanitizer stands in the way, by
// a malloc of its own, which OpenMP's threads and the C library call too.
#include <doctest/doctest.h>

#include <atomic>
#include <cstdlib>
#include <new>
#include <string>
#include <vector>

#include "sim/cpu_engine.h"
#include "sim/sample_tree.h"

namespace {

std::atomic<bool> counting{false};
std::atomic<std::size_t> taken{0};

void count() {
  if (counting.load(std::memory_order_relaxed)) taken.fetch_add(1, std::memory_order_relaxed);
}

void* take(std::size_t bytes, std::size_t alignment) {
  count();
  const std::size_t size = bytes > 0 ? bytes : 1;
  void* memory = alignment == 0 ? std::malloc(size)
                                : std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define WINDFALL_COUNTS_MALLOC 1
extern "C" {
// NOLINTBEGIN(bugprone-reserved-identifier): glibc's names for its own
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);

void* malloc(std::size_t bytes) {
  count();
  return __libc_malloc(bytes);
}
void* calloc(std::size_t items, std::size_t bytes) {
  count();
  return __libc_calloc(items, bytes);
}
void* realloc(void* memory, std::size_t bytes) {
  count();
  return __libc_realloc(memory, bytes);
}
void* aligned_alloc(std::size_t alignment, std::size_t bytes) {
  count();
  return __libc_memalign(alignment, bytes);
}
// NOLINTEND(bugprone-reserved-identifier)
}
#endif

void* operator new(std::size_t bytes) { return take(bytes, 0); }
void* operator new[](std::size_t bytes) { return take(bytes, 0); }
void* operator new(std::size_t bytes, std::align_val_t alignment) {
  return take(bytes, static_cast<std::size_t>(alignment));
}
void* operator new[](std::size_t bytes, std::align_val_t alignment) {
  return take(bytes, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

using namespace windfall::sim;

namespace {

template <class Work>
std::size_t takenBy(const Work& work) {
  taken = 0;
  counting = true;
  work();
  counting = false;
  return taken;
}

SceneDescription scene(TreeMethod method) {
  SceneDescription description;
  const auto tree = std::make_shared<Tree>(sampleTree());
  description.trees.push_back({tree, {}});
  description.trees.push_back({tree, {windfall::vec3(9, 0, 2), 1}});
  description.wind.speed = 9;
  description.wind.fans.push_back({});
  description.leaves.count = 2000;
  description.leaves.season = 0;
  description.solver.method = method;
  return description;
}

/// Gusts from a breath to a storm, in which leaves fall, over three trees of two kinds.
SceneDescription gusts(TreeMethod method, bool moving) {
  SceneDescription description;
  const auto large = std::make_shared<Tree>(sampleTree());
  SampleTreeSettings settings;
  settings.orders = 3;
  settings.height = 5;
  settings.baseRadius = 0.05f;
  const auto small = std::make_shared<Tree>(sampleTree(settings));
  description.trees = {{large, {}}, {small, {windfall::vec3(5, 0, 2), 1}}, {large, {windfall::vec3(-6, 0, 3), 2}}};
  description.wind.speed = 10;
  description.wind.course = WindCourse::Curve;
  description.wind.curve = {{0, 0.1f, 0}, {2, 3, 30}, {4, 0.1f, -60}};
  description.leaves.count = 3000;
  description.leaves.season = 0.8f;
  description.solver.method = method;
  description.solver.axisMotion = moving;
  return description;
}

class WatchedEngine : public CpuEngine {
 public:
  using CpuEngine::CpuEngine;
  using CpuEngine::trees;
};

}  // namespace

TEST_CASE("the counter counts") {
  CHECK(takenBy([] {
          std::vector<int> some(100);
          CHECK(some.size() == 100);
        }) >= 1);
#if defined(WINDFALL_COUNTS_MALLOC)
  CHECK(takenBy([] { std::free(std::malloc(1000)); }) == 1);
#endif
  CHECK(takenBy([] {}) == 0);
}

TEST_CASE("a step of any method with trees, leaves and fans takes no memory, nor does showing it") {
  for (const TreeMethod method : {TreeMethod::Coupled, TreeMethod::Analytic, TreeMethod::Forces, TreeMethod::Literal}) {
    for (const int threads : {1, 2}) {
      CAPTURE(std::string(nameOf(method)));
      CAPTURE(threads);
      const auto engine = Engine::create(scene(method), Device::Cpu, threads);
      REQUIRE(engine);
      std::vector<windfall::mat4> bones((*engine)->linkCount());
      std::vector<windfall::LeafInstance> leaves((*engine)->leafCount());
      (*engine)->step();
      (*engine)->write(bones, leaves);
      CHECK(takenBy([&] {
              for (int i = 0; i < 90; ++i) {
                (*engine)->advance(1.0 / 60);
                (*engine)->write(bones, leaves);
              }
            }) == 0);
      (*engine)->setPull(Pull{40, windfall::vec3(0, 3, 0), windfall::vec3(1, 3, 0)});
      CHECK(takenBy([&] {
              for (int i = 0; i < 30; ++i) (*engine)->step();
            }) == 0);
    }
  }
}

TEST_CASE("steps in which the level of the wind changes and leaves are lost take no memory") {
  struct Case {
    TreeMethod method;
    bool moving;
  };
  for (const Case one :
       {Case{TreeMethod::Coupled, false}, Case{TreeMethod::Analytic, false}, Case{TreeMethod::Analytic, true},
        Case{TreeMethod::Forces, false}, Case{TreeMethod::Literal, false}}) {
    for (const int threads : {1, 2}) {
      CAPTURE(std::string(nameOf(one.method)));
      CAPTURE(threads);
      WatchedEngine engine(gusts(one.method, one.moving), threads);
      engine.step();
      int levels = 0, losses = 0;
      double level = engine.trees().settings().windSpeed;
      float lost = 0;
      CHECK(takenBy([&] {
              for (int i = 0; i < 300; ++i) {
                engine.step();
                levels += engine.trees().settings().windSpeed != level ? 1 : 0;
                level = engine.trees().settings().windSpeed;
                float now = 0;
                for (const float area : engine.trees().lostArea()) now += area;
                losses += now != lost ? 1 : 0;
                lost = now;
              }
            }) == 0);
      CHECK(levels >= 3);
      CHECK(losses >= 1);
    }
  }
}
