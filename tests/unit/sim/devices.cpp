// One body of tests for every device; a device that this machine lacks is skipped by its name.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "kernels/link_treelet.h"
#include "sim/engine.h"
#include "sim/sample_tree.h"
#include "sim/tree_field.h"
#include "sim/wind.h"

using namespace windfall;
using namespace windfall::sim;

namespace {

bool present(Device device) {
  for (const DeviceInfo& info : devices()) {
    if (info.device == device) return true;
  }
  MESSAGE("skipped: this machine has no CUDA device");
  return false;
}

SceneDescription forest() {
  SceneDescription description;
  auto tree = std::make_shared<Tree>(sampleTree());
  description.trees.push_back({tree, {}});
  description.trees.push_back({tree, {vec3(8, 0, 3), 1}});
  description.wind.speed = 9;
  description.leaves.count = 0;
  return description;
}

}  // namespace

TEST_CASE("every device moves the trees as the CPU does") {
  for (const Device device : {Device::Cpu, Device::Cuda}) {
    if (!present(device)) continue;
    const auto reference = Engine::create(forest(), Device::Cpu, 1), engine = Engine::create(forest(), device, 2);
    REQUIRE(reference);
    REQUIRE(engine);
    CHECK((*engine)->device().device == device);
    for (int i = 0; i < 120; ++i) {
      (*reference)->step();
      (*engine)->step();
    }
    CHECK((*engine)->deviceProblem().empty());
    const Statistics a = (*reference)->statistics(), b = (*engine)->statistics();
    CHECK(a.tipDisplacement == doctest::Approx(b.tipDisplacement).epsilon(1e-4));
    CHECK(a.elasticEnergy == doctest::Approx(b.elasticEnergy).epsilon(1e-3));
    std::vector<mat4> first((*reference)->linkCount()), second(first.size());
    (*reference)->write(first, {});
    (*engine)->write(second, {});
    float farthest = 0;
    for (std::size_t i = 0; i < first.size(); ++i) {
      for (int k = 0; k < 4; ++k) farthest = std::max(farthest, glm::length(first[i][k] - second[i][k]));
    }
    CHECK(farthest < 1e-4f);
  }
}

TEST_CASE("the automatic choice always works, and a missing device is named") {
  const auto automatic = Engine::create(forest(), Device::Auto);
  REQUIRE(automatic);
  CHECK(devices().front().device == Device::Cpu);
  if (devices().size() == 1) {
    CHECK((*automatic)->device().device == Device::Cpu);
    const auto cuda = Engine::create(forest(), Device::Cuda);
    REQUIRE_FALSE(cuda);
    CHECK(cuda.error().message.rfind("no CUDA device: ", 0) == 0);
  }
}

// Compiled here for the plainest instruction set, while the loops run on the best one of this machine.
TEST_CASE("the sweep of a group of threads gives the bits of the loops, on any instruction set") {
  const SceneDescription description = forest();
  WindField wind(vec3(-10, 0, -10), vec3(15, 12, 15), description.wind, 1);
  wind.advance(1);
  FactorSettings settings;
  settings.windSpeed = 9;
  TreeField field(description.trees, settings, 1, 200), grouped(description.trees, settings, 1, 200);
  std::vector<std::int32_t> parents;
  for (const LinkShape& shape : field.shapes()) parents.push_back(shape.parent);
  const cuda::Forest arrays = forestOf(field.cut(), parents);
  std::vector<LinkLoad> loads(field.size()), exports(field.size());
  const ForestView forestView{arrays.order.data(),    arrays.levels.data(),     arrays.parts.data(),
                              arrays.children.data(), arrays.childBegin.data(), exports.data()};
  const auto parts = static_cast<std::uint32_t>(arrays.parts.size()) - 1;
  const auto wait = [] {};
  for (int i = 0; i < 30; ++i) {
    field.step(wind.view());
    std::vector<LinkMotion> motion(grouped.motion().begin(), grouped.motion().end());
    std::vector<LinkState> now(grouped.size());
    const LinksView links{grouped.shapes().data(),
                          grouped.factors().data(),
                          motion.data(),
                          loads.data(),
                          grouped.current().data(),
                          now.data()};
    const LinkStepParameters step{static_cast<float>(settings.h), static_cast<float>(settings.implicitness)};
    for (std::uint32_t k = 0; k < grouped.size(); ++k) linkForces(links, wind.view(), k);
    for (std::uint32_t part = 1; part < parts; ++part) sweepUp(links, forestView, step, part, 0, 1, wait);
    sweepUp(links, forestView, step, 0, 0, 1, wait);
    sweepDown(links, forestView, step, 0, 0, 1, wait);
    for (std::uint32_t part = 1; part < parts; ++part) sweepDown(links, forestView, step, part, 0, 1, wait);
    grouped.takeStep(motion, now);
  }
  for (std::size_t i = 0; i < field.size(); ++i) {
    REQUIRE(field.current()[i].position == grouped.current()[i].position);
    REQUIRE(field.current()[i].rotation == grouped.current()[i].rotation);
  }
}
