#include "sim/engine.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "sim/sample_tree.h"

using namespace windfall;
using namespace windfall::sim;

namespace {

SceneDescription scene(float speed = 8) {
  SampleTreeSettings settings;
  settings.children = {8, 5, 3};
  SceneDescription description;
  description.trees.push_back({std::make_shared<Tree>(sampleTree(settings)), {}});
  description.wind.speed = speed;
  description.leaves.count = 200;
  return description;
}

std::unique_ptr<Engine> make(const SceneDescription& description, int threads = 1) {
  auto engine = Engine::create(description, Device::Cpu, threads);
  REQUIRE(engine);
  return std::move(*engine);
}

void run(Engine& engine, int steps) {
  for (int i = 0; i < steps; ++i) engine.step();
}

}  // namespace

TEST_CASE("equal scenes give equal bits for one thread and for two") {
  const auto one = make(scene(), 1), two = make(scene(), 2);
  run(*one, 120);
  run(*two, 120);
  CHECK(one->hash() == two->hash());
  SceneDescription other = scene();
  other.wind.seed = 2;
  const auto different = make(other);
  run(*different, 120);
  CHECK(different->hash() != one->hash());
}

TEST_CASE("at most eight steps are made for a frame, and what is lost is told") {
  const auto engine = make(scene());
  Advance done = engine->advance(0.1);
  CHECK(done.steps == 6);
  CHECK(done.lost == 0);
  CHECK(engine->advance(1e-4).steps == 0);
  done = engine->advance(1.0);
  CHECK(done.steps == 8);
  CHECK(done.lost == doctest::Approx(1 - 8.0 / 60).epsilon(0.02));
  CHECK(engine->time() == doctest::Approx(14.0 / 60));
  CHECK(engine->advance(-1).steps == 0);
  CHECK(engine->advance(std::numeric_limits<double>::quiet_NaN()).steps == 0);
  CHECK(engine->advance(1.0 / 60).steps == 1);
}

TEST_CASE("bones are the placement at rest and move smoothly between steps") {
  SceneDescription description = scene();
  description.trees[0].placement = {vec3(3, 0, -2), 0.7f};
  const auto engine = make(description);
  std::vector<mat4> bones(engine->linkCount());
  std::vector<LeafInstance> leaves(engine->leafCount());
  engine->write(bones, leaves);
  const mat4 turn = glm::mat4_cast(glm::angleAxis(0.7f, vec3(0, 1, 0)));
  for (const std::size_t i : {std::size_t{0}, bones.size() / 2, bones.size() - 1}) {
    const vec4 joint(description.trees[0].tree->links[i].joint, 1);
    const vec3 expected = vec3(turn * joint) + vec3(3, 0, -2);
    CHECK(glm::length(vec3(bones[i] * joint) - expected) < 1e-4f);
  }
  run(*engine, 60);
  const std::size_t last = bones.size() - 1;
  const vec4 joint(description.trees[0].tree->links[last].joint, 1);
  // Over a third of a step the place moves by a third of the way.
  engine->advance(1.001 / 60);
  engine->write(bones, leaves);
  const vec3 start(bones[last] * joint);
  engine->advance(1.0 / 180);
  engine->write(bones, leaves);
  const vec3 third(bones[last] * joint);
  engine->advance(1.0 / 180);
  engine->write(bones, leaves);
  const vec3 twoThirds(bones[last] * joint);
  CHECK(glm::length(third - start) > 1e-6f);
  CHECK(glm::length((twoThirds - start) - 2.f * (third - start)) < 0.05f * glm::length(twoThirds - start) + 1e-5f);
}

TEST_CASE("a saved state goes on with the same bits") {
  const auto engine = make(scene());
  run(*engine, 45);
  WindSettings wind = scene().wind;
  wind.speed = 11;
  engine->setWind(wind);
  run(*engine, 30);
  engine->advance(0.005);
  const std::vector<std::uint8_t> bytes = engine->save();
  CHECK(engine->save() == bytes);

  SceneDescription again = scene();
  again.wind = wind;
  const auto other = make(again);
  run(*other, 10);
  REQUIRE(other->restore(bytes));
  CHECK(other->hash() == engine->hash());
  CHECK(other->save() == bytes);
  run(*engine, 50);
  run(*other, 50);
  CHECK(other->hash() == engine->hash());
  CHECK(other->time() == engine->time());
}

TEST_CASE("a damaged or foreign state is refused and changes nothing") {
  const auto engine = make(scene());
  run(*engine, 20);
  const std::vector<std::uint8_t> good = engine->save();
  run(*engine, 5);
  const std::uint64_t before = engine->hash();
  const auto refused = [&](const std::vector<std::uint8_t>& bytes) {
    const Status status = engine->restore(bytes);
    return !status && !status.error().message.empty() && engine->hash() == before;
  };
  CHECK(refused({}));
  CHECK(refused({1, 2, 3}));
  for (std::size_t size = 0; size < good.size(); size += 1 + good.size() / 97) {
    CHECK(refused({good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size)}));
  }
  for (std::size_t at = 0; at < good.size(); at += 1 + good.size() / 211) {
    std::vector<std::uint8_t> bad = good;
    bad[at] ^= 0x5au;
    CHECK(refused(bad));
  }
  std::vector<std::uint8_t> longer = good;
  longer.push_back(0);
  CHECK(refused(longer));
  std::vector<std::uint8_t> newer = good;
  newer[8] = 99;
  CHECK(engine->restore(newer).error().message.find("version 99") != std::string::npos);

  SceneDescription other = scene();
  other.seed = 77;
  CHECK(make(other)->restore(good).error().message == "the state belongs to another scene");
  CHECK(engine->restore(good));
}

TEST_CASE("a reset is the beginning") {
  const auto engine = make(scene()), fresh = make(scene());
  run(*engine, 40);
  engine->reset();
  CHECK(engine->time() == 0);
  CHECK(engine->hash() == fresh->hash());
  run(*engine, 30);
  run(*fresh, 30);
  CHECK(engine->hash() == fresh->hash());
}

TEST_CASE("when the wind ends the tree comes to rest") {
  SceneDescription description = scene(12);
  description.wind.until = 10;
  description.leaves.count = 0;
  const auto engine = make(description);
  double peak = 0;
  for (int i = 0; i < 600; ++i) {
    engine->step();
    const Statistics s = engine->statistics();
    peak = std::max(peak, s.kineticEnergy + s.elasticEnergy);
  }
  run(*engine, 50 * 60);
  const Statistics s = engine->statistics();
  CHECK(peak > 1);
  CHECK(s.kineticEnergy + s.elasticEnergy < 0.01 * peak);
}

TEST_CASE("leaves come loose, are counted, and their tree grows lighter") {
  SceneDescription description = scene(14);
  description.leaves.count = 400;
  description.leaves.season = 1;
  const auto engine = make(description);
  Statistics s = engine->statistics();
  CHECK(engine->leafCount() == 400);
  CHECK(s.attached == 400);
  CHECK(s.landed == 0);
  run(*engine, 20 * 60);
  s = engine->statistics();
  CHECK(s.attached + s.airborne + s.grounded == 400);
  CHECK(s.attached < 200);
  CHECK(s.grounded > 0);
  CHECK(s.landed >= s.grounded);
  CHECK(s.fallTimeSum / static_cast<double>(s.landed) > 0.5);

  // The state goes on with the same bits after leaves fell and masses changed.
  const auto other = make(description);
  REQUIRE(other->restore(engine->save()));
  CHECK(other->hash() == engine->hash());
  run(*engine, 90);
  run(*other, 90);
  CHECK(other->hash() == engine->hash());

  // Without leaves the wind has less to push at.
  SceneDescription green = description;
  green.leaves.season = 0;
  const auto leafy = make(green);
  run(*leafy, 20 * 60);
  CHECK(leafy->statistics().attached == 400);
  double bare = 0, full = 0;
  for (int i = 0; i < 10 * 60; ++i) {
    engine->step();
    leafy->step();
    bare += static_cast<double>(engine->statistics().tipDisplacement);
    full += static_cast<double>(leafy->statistics().tipDisplacement);
  }
  CHECK(bare < 0.9 * full);

  engine->reset();
  CHECK(engine->statistics().attached == 400);
  CHECK(engine->hash() == make(description)->hash());
}

TEST_CASE("ten times a storm keeps the tree in bounds") {
  SceneDescription description = scene(80);
  for (const float stiffness : {1.f, 0.01f, 100.f}) {
    CAPTURE(stiffness);
    Tree tree = *scene().trees[0].tree;
    for (Link& link : tree.links) link.stiffnessScale = stiffness;
    description.trees[0].tree = std::make_shared<Tree>(tree);
    const auto engine = make(description);
    std::vector<mat4> bones(engine->linkCount());
    std::vector<LeafInstance> leaves(engine->leafCount());
    float farthest = 0;
    for (int i = 0; i < 600; ++i) {
      engine->step();
      engine->write(bones, leaves);
      for (std::size_t k = 0; k < bones.size(); k += 50) {
        const vec3 at(bones[k] * vec4(tree.links[k].joint, 1));
        REQUIRE(std::isfinite(at.x + at.y + at.z));
        farthest = std::max(farthest, glm::length(at));
      }
    }
    CHECK(farthest < 20);
    CHECK(std::isfinite(engine->statistics().kineticEnergy));
  }
}

TEST_CASE("stiffness changes while the tree moves") {
  const SceneDescription description = scene();
  const auto engine = make(description);
  run(*engine, 60);
  const float before = engine->statistics().tipDisplacement;
  Tree stiff = *description.trees[0].tree;
  for (Link& link : stiff.links) link.stiffnessScale = 50;
  engine->setTree(0, std::make_shared<Tree>(stiff));
  CHECK(engine->statistics().tipDisplacement == before);
  run(*engine, 300);
  CHECK(engine->statistics().tipDisplacement < 0.5f * before);
  // A tree of other links is not taken.
  engine->setTree(0, std::make_shared<Tree>(cantilever(3, 1, 0.01f)));
  engine->setTree(7, std::make_shared<Tree>(stiff));
  CHECK(engine->linkCount() == stiff.links.size());
}

TEST_CASE("a scene that can't be simulated is refused in one line") {
  SceneDescription bad = scene();
  bad.solver.step = 0;
  CHECK_FALSE(Engine::create(bad, Device::Cpu));
  bad = scene();
  Tree tree = *bad.trees[0].tree;
  tree.links[4].radius = std::numeric_limits<float>::quiet_NaN();
  bad.trees[0].tree = std::make_shared<Tree>(tree);
  CHECK(Engine::create(bad, Device::Cpu).error().message == "link 4 of sample tree: it has no thickness");
  bad.trees[0].tree = nullptr;
  CHECK_FALSE(Engine::create(bad, Device::Cpu));
  bad = scene();
  bad.trees[0].placement.heading = std::numeric_limits<float>::infinity();
  CHECK_FALSE(Engine::create(bad, Device::Cpu));
}

TEST_CASE("a scene without trees is a windy meadow") {
  SceneDescription empty;
  empty.leaves.count = 0;
  const auto engine = make(empty);
  run(*engine, 5);
  CHECK(engine->linkCount() == 0);
  CHECK(engine->statistics().tipDisplacement == 0);
}
