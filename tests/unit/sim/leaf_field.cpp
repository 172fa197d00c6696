#include "sim/leaf_field.h"

#include <doctest/doctest.h>
#include <omp.h>

#include <algorithm>
#include <set>
#include <vector>

#include "kernels/leaf_range.h"
#include "kernels/leaf_step.h"
#include "sim/leaf_sites.h"
#include "sim/leaf_storage.h"
#include "support/leaf_scene.h"

using namespace windfall;
using namespace windfall::sim;
using namespace windfall::test;

namespace {

void run(LeafStage& stage, int steps) {
  for (int k = 0; k < steps; ++k) {
    stage.blow(vec3(6 + 3 * std::sin(0.05f * static_cast<float>(k)), 0, 1));
    stage.step();
  }
}

/// What the engine would do with each field of leaves: 400 steps of a leaf scene, by any way of stepping.
template <class Step>
std::uint64_t hashAfter(const SceneDescription& scene, Step&& step) {
  LeafStage stage(scene);
  LeafStorage& storage = const_cast<LeafStorage&>(stage.field.storage());
  for (int k = 0; k < 400; ++k) {
    stage.blow(vec3(6 + 3 * std::sin(0.05f * static_cast<float>(k)), 0, 1));
    LeafStep constants = storage.stepAt(stage.time, 1.0f / 60);
    constants.links = stage.links();
    constants.wind = stage.wind();
    step(storage.arrays, constants);
    storage.swapSides();
    ++storage.stepNumber;
    stage.time += static_cast<double>(1.0f / 60);
  }
  return stage.field.hash();
}

}  // namespace

TEST_CASE("leaves take sites evenly, and share them where there are too few") {
  std::vector<TreeInstance> trees{{poleWithLeaves(300), {}}, {poleWithLeaves(100), {}}};
  const std::vector<LeafPlace> few = chooseSites(trees, 100, 5);
  REQUIRE(few.size() == 100);
  CHECK(std::count_if(few.begin(), few.end(), [](const LeafPlace& p) { return p.link == 0; }) == 75);
  std::set<std::pair<std::uint32_t, float>> different;
  for (const LeafPlace& place : few) different.insert({place.link, place.site.position.z});
  CHECK(different.size() == 100);

  const std::vector<LeafPlace> many = chooseSites(trees, 1000, 5);
  REQUIRE(many.size() == 1000);
  CHECK(std::count_if(many.begin(), many.end(), [](const LeafPlace& p) { return p.link == 0; }) == 750);
  std::set<std::array<float, 3>> places;
  for (const LeafPlace& p : many) {
    if (p.link == 0) places.insert({p.site.position.x, p.site.position.y, p.site.position.z});
    CHECK(p.site.position.z <= 4);
    CHECK(std::abs(glm::length(p.site.rotation) - 1) < 1e-5f);
  }
  CHECK(places.size() == 750);
  CHECK(chooseSites({}, 10, 1).empty());
}

TEST_CASE("a scene without trees lets its leaves fall from 10 m") {
  SceneDescription scene;
  scene.leaves.count = 50;
  LeafStage stage(scene);
  CHECK(stage.field.counts().airborne == 50);
  for (const LeafInstance& leaf : stage.show(1)) {
    CHECK(leaf.position.y == doctest::Approx(10).epsilon(0.01));
    CHECK(leaf.size > 0.03f);
    CHECK(leaf.size < 0.17f);
  }
  scene.leaves.count = 0;
  CHECK(LeafStage(scene).field.size() == 0);
}

TEST_CASE("every instruction set, any number of threads and the device's way of stepping give the same bits") {
  const SceneDescription scene = leavesOnPole(5003, 0.9f);
  const auto byRange = [](LeafRange range) {
    return [range](const LeafArrays& a, const LeafStep& step) { range(a, 0, a.count, step); };
  };
  const std::uint64_t plain = hashAfter(scene, byRange(leafRange(0)));
  for (int level = 2; level <= bestLevel(); ++level) {
    CAPTURE(level);
    CHECK(hashAfter(scene, byRange(leafRange(level))) == plain);
  }
  CHECK(hashAfter(scene, [](const LeafArrays& a, const LeafStep& step) {
          for (std::uint32_t i = 0; i < a.count; ++i) stepLeaf(a, i, step, kLeafBlock);
        }) == plain);

  const int threads = omp_get_max_threads();
  std::vector<std::uint64_t> hashes;
  for (const int n : {1, 2}) {
    omp_set_num_threads(n);
    LeafStage stage(scene);
    run(stage, 400);
    hashes.push_back(stage.field.hash());
    CHECK(stage.field.counts().attached < 5003);
    CHECK(stage.field.counts().grounded > 0);
  }
  omp_set_num_threads(threads);
  CHECK(hashes[0] == hashes[1]);
  CHECK(hashes[0] == plain);
  CHECK(hashAfter(leavesOnPole(5003, 0.9f, 500, 2), byRange(leafRange(0))) != plain);
}

TEST_CASE("a saved state goes on with the same bits") {
  const SceneDescription scene = leavesOnPole(1000, 0.95f);
  LeafStage one(scene), two(scene);
  run(one, 301);  // odd: the two sides of the state have changed places
  const std::vector<std::uint8_t> bytes = one.field.save();
  REQUIRE(two.field.restore(bytes));
  CHECK(two.field.hash() == one.field.hash());
  CHECK(two.field.save() == bytes);
  two.time = one.time;
  run(one, 200);
  run(two, 200);
  CHECK(two.field.hash() == one.field.hash());
  CHECK(two.field.fallTimeSum() == one.field.fallTimeSum());
}

TEST_CASE("bytes of another scene, another version, or damaged ones are refused and change nothing") {
  LeafStage stage(leavesOnPole(200, 0.95f));
  run(stage, 200);
  const std::vector<std::uint8_t> good = stage.field.save();
  LeafStage other(leavesOnPole(200, 0.95f, 500, 2)), target(leavesOnPole(200, 0.95f));
  const std::uint64_t before = target.field.hash();
  CHECK(other.field.restore(good).error().message == "the state of the leaves belongs to another scene");
  const auto refuses = [&](std::vector<std::uint8_t> bytes) {
    const Status status = target.field.restore(bytes);
    return !status && !status.error().message.empty() && target.field.hash() == before;
  };
  CHECK(refuses({}));
  CHECK(refuses(std::vector<std::uint8_t>(good.begin(), good.begin() + 20)));
  CHECK(refuses(std::vector<std::uint8_t>(good.begin(), good.end() - 4)));
  std::vector<std::uint8_t> longer = good;
  longer.push_back(0);
  CHECK(refuses(longer));
  // From the header on, in strides that meet every array.
  for (std::size_t at = 0; at < good.size(); at += at < 48 ? 1 : 397) {
    if (at >= 32 && at < 48) continue;  // time, step: any value is one
    std::vector<std::uint8_t> bad = good;
    bad[at] ^= 0x41;
    CAPTURE(at);
    CHECK(refuses(bad));
  }
  CHECK(target.field.restore(good));
}

TEST_CASE("reset brings back the start") {
  LeafStage stage(leavesOnPole(500, 1));
  const std::uint64_t start = stage.field.hash();
  run(stage, 151);
  CHECK(stage.field.hash() != start);
  stage.field.reset();
  CHECK(stage.field.hash() == start);
  CHECK(stage.field.counts().attached == 500);
  CHECK(stage.field.landed() == 0);
}

TEST_CASE("a link loses a leaf's share of its area, and gets it back on reset") {
  LeafStage stage(leavesOnPole(500, 1));
  std::vector<float> area(1, 0.0f);
  CHECK_FALSE(stage.field.findLostArea(area));
  run(stage, 120);
  CHECK(stage.field.findLostArea(area));
  const int gone = 500 - stage.field.counts().attached;
  CHECK(gone > 0);
  CHECK(area[0] == doctest::Approx(0.003 * gone));
  CHECK_FALSE(stage.field.findLostArea(area));
  stage.field.reset();
  CHECK(stage.field.findLostArea(area));
  CHECK(area[0] == doctest::Approx(0).epsilon(1e-4));
}

TEST_CASE("leaves on the ground grow again where they hung, as other leaves") {
  SceneDescription scene = leavesOnPole(300, 1);
  scene.leaves.respawn = true;
  LeafStage stage(scene);
  const LeafArrays& a = stage.field.storage().arrays;
  bool conserved = true;
  float largest = 0;
  std::vector<LeafInstance> before = stage.show(1);
  for (int k = 0; k < 60 * 50; ++k) {
    stage.step();
    const LeafCounts counts = stage.field.counts();
    conserved = conserved && counts.attached + counts.airborne + counts.grounded == 300;
    const std::vector<LeafInstance> after = stage.show(1);
    for (std::size_t i = 0; i < after.size(); ++i)
      largest = std::max(largest, std::abs(after[i].size - before[i].size));
    before = after;
  }
  CHECK(conserved);
  CHECK(largest < 0.01f);  // none appears or vanishes at once
  CHECK(std::count_if(a.generation, a.generation + 300, [](std::uint32_t g) { return g > 0; }) > 200);
  CHECK(stage.field.landed() > 300);

  scene = looseLeaves(200, 8);
  scene.leaves.respawn = true;
  LeafStage loose(scene);
  for (int k = 0; k < 60 * 45; ++k) loose.step();
  CHECK(loose.field.counts().attached == 0);
  CHECK(loose.field.counts().airborne > 0);
}

TEST_CASE("season and mass change in place, another count starts anew") {
  SceneDescription scene = leavesOnPole(400, 0);
  LeafStage stage(scene);
  run(stage, 60);
  CHECK(stage.field.counts().attached == 400);
  LeafSettings settings = scene.leaves;
  settings.season = 1;
  settings.massPerArea = 0.2f;
  CHECK_FALSE(stage.field.setSettings(settings));
  run(stage, 120);
  CHECK(stage.field.counts().attached < 300);
  settings.count = 100;
  CHECK(stage.field.setSettings(settings));
  CHECK(stage.field.size() == 100);
  CHECK(stage.field.counts().attached == 100);
  settings.spawnHeight = 5;
  CHECK(stage.field.setSettings(settings));
  CHECK(stage.field.counts().airborne == 100);
}
