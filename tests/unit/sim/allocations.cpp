// A step takes no memory: counted by operators new of this program's own.
#include <doctest/doctest.h>

#include <atomic>
#include <cstdlib>
#include <new>
#include <string>
#include <vector>

#include "sim/engine.h"
#include "sim/sample_tree.h"

namespace {

std::atomic<bool> counting{false};
std::atomic<std::size_t> taken{0};

void* take(std::size_t bytes, std::size_t alignment) {
  if (counting.load(std::memory_order_relaxed)) taken.fetch_add(1, std::memory_order_relaxed);
  const std::size_t size = bytes > 0 ? bytes : 1;
  void* memory = alignment == 0 ? std::malloc(size)
                                : std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace

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

}  // namespace

TEST_CASE("the counter counts") {
  CHECK(takenBy([] {
          std::vector<int> some(100);
          CHECK(some.size() == 100);
        }) >= 1);
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
