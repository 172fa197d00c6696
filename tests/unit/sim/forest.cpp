// Many trees of several species, stepped as one: the same bits for any number of threads, and each as if alone.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "sim/engine.h"
#include "sim/sample_tree.h"
#include "sim/tree_field.h"
#include "support/uniform_wind.h"

using namespace windfall;
using namespace windfall::sim;
using windfall::test::UniformWind;

namespace {

/// A broadleaf, a conifer with a deep trunk, a sapling of few links.
std::vector<std::shared_ptr<const Tree>> species() {
  SampleTreeSettings broadleaf, conifer, sapling;
  broadleaf.children = {8, 5, 3};
  conifer.orders = 3;
  conifer.segments = {120, 4, 2, 1};
  conifer.children = {60, 4, 0};
  conifer.seed = 2;
  sapling.height = 2;
  sapling.baseRadius = 0.02f;
  sapling.orders = 2;
  sapling.segments = {5, 2, 1, 1};
  sapling.children = {8, 0, 0};
  sapling.seed = 3;
  std::vector<std::shared_ptr<const Tree>> all;
  for (const SampleTreeSettings& settings : {broadleaf, conifer, sapling}) {
    all.push_back(std::make_shared<Tree>(sampleTree(settings)));
  }
  return all;
}

std::vector<TreeInstance> forest(int count) {
  const auto kinds = species();
  std::vector<TreeInstance> trees;
  for (int i = 0; i < count; ++i) {
    const auto index = static_cast<std::size_t>(i);
    const vec3 place(static_cast<float>(6 * (i % 5)), 0, static_cast<float>(7 * (i / 5)));
    trees.push_back({kinds[index % kinds.size()], {place, 0.7f * static_cast<float>(i)}});
  }
  return trees;
}

}  // namespace

TEST_CASE("a forest of three species gives equal bits on 1, 2 and 4 threads, by every method") {
  for (const TreeMethod method : {TreeMethod::Coupled, TreeMethod::Analytic, TreeMethod::Forces, TreeMethod::Literal}) {
    for (const bool moving : {false, true}) {
      if (moving && method != TreeMethod::Analytic) continue;
      CAPTURE(std::string(nameOf(method)));
      SceneDescription scene;
      scene.trees = forest(11);
      scene.wind.speed = 12;
      scene.leaves.count = 6000;
      scene.leaves.season = 0.9f;
      scene.solver.method = method;
      scene.solver.axisMotion = moving;
      std::uint64_t first = 0;
      for (const int threads : {1, 2, 4}) {
        CAPTURE(threads);
        const auto engine = Engine::create(scene, Device::Cpu, threads);
        REQUIRE(engine);
        for (int i = 0; i < 75; ++i) (*engine)->step();
        CHECK((*engine)->statistics().largestAngle > 0.001f);
        CHECK((*engine)->statistics().attached < 6000);
        if (first == 0) first = (*engine)->hash();
        CHECK((*engine)->hash() == first);
      }
    }
  }
}

TEST_CASE("small trees share the parts that threads take, and each moves as if it stood alone") {
  const UniformWind wind(vec3(9, 0, 3));
  for (const TreeMethod method : {TreeMethod::Coupled, TreeMethod::Analytic}) {
    CAPTURE(std::string(nameOf(method)));
    FactorSettings settings;
    settings.method = method;
    settings.windSpeed = 9;
    std::vector<TreeInstance> trees = forest(9);
    const auto sapling = trees[2].tree;
    for (int i = 0; i < 150; ++i) trees.push_back({sapling, {vec3(30, 0, static_cast<float>(i)), 0.1f}});
    TreeField all(trees, settings, 2);
    CHECK(all.slots().parts.size() < 30);
    for (int i = 0; i < 60; ++i) all.step(wind.view());
    for (const std::size_t t : {std::size_t{0}, std::size_t{1}, std::size_t{2}, trees.size() - 1}) {
      CAPTURE(t);
      TreeField alone({trees[t]}, settings, 1);
      for (int i = 0; i < 60; ++i) alone.step(wind.view());
      float farthest = 0, moved = 0;
      for (std::size_t i = 0; i < alone.size(); ++i) {
        const LinkState &a = alone.current()[i], &b = all.current()[all.firstLinks()[t] + i];
        farthest = std::max(farthest, glm::length(a.position - b.position));
        moved = std::max(moved, glm::length(alone.angle(i)));
      }
      CHECK(moved > 1e-4f);
      CHECK(farthest < 2e-5f);
    }
  }
}
