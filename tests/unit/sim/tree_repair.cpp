// Trees of any quality: the repair makes them fit, says what it did, and every method then bears them.
#include "sim/tree_repair.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "kernels/random.h"
#include "sim/bodies.h"
#include "sim/engine.h"
#include "sim/sample_tree.h"

using namespace windfall;
using namespace windfall::sim;

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

Tree small() {
  SampleTreeSettings settings;
  settings.children = {4, 3, 2};
  return sampleTree(settings);
}

/// Some seconds of wind by a method; the largest angle of a joint, or not a number.
float sway(const Tree& tree, TreeMethod method, int steps = 90) {
  SceneDescription scene;
  scene.trees.push_back({std::make_shared<Tree>(tree), {}});
  scene.leaves.count = 50;
  scene.wind.speed = 10;
  scene.solver.method = method;
  const auto engine = Engine::create(scene, Device::Cpu, 1);
  REQUIRE_MESSAGE(engine, (engine ? std::string() : engine.error().message));
  for (int i = 0; i < steps; ++i) (*engine)->step();
  std::vector<mat4> bones((*engine)->linkCount());
  std::vector<LeafInstance> leaves((*engine)->leafCount());
  (*engine)->write(bones, leaves);
  for (const mat4& bone : bones) {
    if (!std::isfinite(glm::dot(bone[0] + bone[1] + bone[2], vec4(1)) + glm::dot(bone[3], vec4(1)))) return kNan;
  }
  const Statistics s = (*engine)->statistics();
  return std::isfinite(s.kineticEnergy) && std::isfinite(s.elasticEnergy) ? s.largestAngle : kNan;
}

void expectSway(const Tree& tree) {
  for (const TreeMethod method : {TreeMethod::Coupled, TreeMethod::Analytic, TreeMethod::Forces, TreeMethod::Literal}) {
    CAPTURE(std::string(nameOf(method)));
    const float angle = sway(tree, method);
    CHECK(std::isfinite(angle));
    CHECK(angle < 100);
  }
}

}  // namespace

TEST_CASE("a sound tree is left as it is") {
  Tree tree = small();
  const Tree before = tree;
  const TreeRepair repair = repairTree(tree);
  CHECK_FALSE(repair.any());
  CHECK_FALSE(repair.reordered);
  REQUIRE(repair.from.size() == before.links.size());
  for (std::size_t i = 0; i < before.links.size(); ++i) {
    CHECK(repair.from[i] == static_cast<std::int32_t>(i));
    CHECK(tree.links[i].joint == before.links[i].joint);
    CHECK(tree.links[i].length == before.links[i].length);
  }
}

TEST_CASE("links without length or thickness and numbers that are none are mended and told") {
  Tree tree = small();
  const vec3 joint = tree.links[9].joint;
  tree.links[3].length = 0;
  tree.links[5].length = kNan;
  tree.links[6].radius = 0;
  tree.links[7].radius = -1;
  tree.links[9].joint = vec3(kNan);
  tree.links[11].rotation = quat(0, 0, 0, 0);
  tree.links[12].rotation = quat(kNan, 0, 0, 0);
  tree.links[13].rotation *= 3.f;
  tree.links[14].woodDensity = 0;
  tree.links[15].youngsModulus = kInfinity;
  tree.links[16].leafArea = -3;
  tree.links[17].windScale = kNan;
  tree.links[18].length = 1e30f;
  tree.sites.push_back({-4});
  const float sideways = tree.links[10].radius;
  CHECK_FALSE(problemOf(tree).empty());
  const TreeRepair repair = repairTree(tree);
  CHECK(problemOf(tree).empty());
  CHECK_FALSE(repair.reordered);
  const std::vector<std::string> expected{
      "link 9 is nowhere and begins where its parent ends",
      "3 links have no direction and take that of their children or parents; the first is link 11",
      "3 links have no length and become stubs; the first is link 3",
      "2 links have no thickness and take a part of their parents'; the first is link 6",
      "2 links have wood of no density or stiffness and get the usual one; the first is link 14",
      "link 16 has a leaf area that is no number and gets none",
      "link 17 has a factor of stiffness, damping or wind that is no number and gets the usual one",
      "one leaf hangs on no link and is dropped"};
  CHECK(repair.notes == expected);
  CHECK(tree.links[3].length > 0);
  CHECK(glm::length(tree.links[9].joint - joint) < 1);
  CHECK(tree.links[10].radius == sideways);
  expectSway(tree);
  // Nothing is left to do.
  CHECK_FALSE(repairTree(tree).any());
}

TEST_CASE("children before parents, loops and parents that are not there become a tree again") {
  const Tree good = small();
  const auto count = static_cast<std::int32_t>(good.links.size());
  SUBCASE("links the other way round") {
    Tree tree = good;
    std::reverse(tree.links.begin(), tree.links.end());
    for (Link& link : tree.links) link.parent = link.parent < 0 ? -1 : count - 1 - link.parent;
    for (LeafSite& site : tree.sites) site.link = count - 1 - site.link;
    const TreeRepair repair = repairTree(tree);
    CHECK(repair.reordered);
    REQUIRE(repair.notes.size() == 1);
    CHECK(problemOf(tree).empty());
    CHECK(tree.links.size() == good.links.size());
    // Every link has kept its parent and its leaves.
    for (std::size_t i = 0; i < tree.links.size(); ++i) {
      const auto original = static_cast<std::size_t>(count - 1 - repair.from[i]);
      CHECK(tree.links[i].joint == good.links[original].joint);
      if (tree.links[i].parent < 0) continue;
      const auto parent = static_cast<std::size_t>(tree.links[i].parent);
      CHECK(good.links[static_cast<std::size_t>(good.links[original].parent)].joint == tree.links[parent].joint);
    }
    CHECK(tree.sites.size() == good.sites.size());
    CHECK(totalMass(tree) == doctest::Approx(totalMass(good)).epsilon(1e-6));
    CHECK(firstFrequency(tree) == doctest::Approx(firstFrequency(good)).epsilon(1e-5));
    expectSway(tree);
  }
  SUBCASE("loops") {
    Tree tree = good;
    tree.links[0].parent = 4;  // 0 1 2 3 4 stand on each other
    tree.links[20].parent = 20;
    const TreeRepair repair = repairTree(tree);
    REQUIRE_FALSE(repair.notes.empty());
    CHECK(repair.notes[0] == "2 links are their own ancestors and become roots; the first is link 0");
    CHECK(problemOf(tree).empty());
    CHECK(tree.links.size() == good.links.size());
    expectSway(tree);
  }
  SUBCASE("parents that are not there") {
    Tree tree = good;
    tree.links[7].parent = 12345678;
    tree.links[8].parent = -5;
    const TreeRepair repair = repairTree(tree);
    REQUIRE_FALSE(repair.notes.empty());
    CHECK(repair.notes[0] == "2 links have a parent that is not there and become roots; the first is link 7");
    CHECK(problemOf(tree).empty());
    expectSway(tree);
  }
}

TEST_CASE("whatever a tree holds, it can be mended") {
  for (std::uint32_t seed = 1; seed <= 40; ++seed) {
    CAPTURE(seed);
    RandomSequence random(seed);
    Tree tree = small();
    const auto pick = [&] {
      return static_cast<std::size_t>(random.uniform() * static_cast<double>(tree.links.size()));
    };
    const auto bad = [&] {
      const float values[] = {0, -1, kNan, kInfinity, -kInfinity, 1e-30f, 1e30f, 3e38f, -0.f, 1e-9f};
      return values[static_cast<std::size_t>(random.uniform() * 10)];
    };
    for (int k = 0; k < 60; ++k) {
      Link& link = tree.links[pick()];
      float* const values[] = {&link.joint.x,       &link.joint.y,      &link.rotation.w,     &link.rotation.x,
                               &link.length,        &link.radius,       &link.leafArea,       &link.woodDensity,
                               &link.youngsModulus, &link.dampingScale, &link.stiffnessScale, &link.windScale,
                               &link.rayleighAlpha, &link.rayleighBeta, &link.propagation};
      *values[static_cast<std::size_t>(random.uniform() * 15)] = bad();
      if (k % 4 == 0) link.parent = static_cast<std::int32_t>(pick()) - (k % 8 == 0 ? 3 : 0);
      if (k % 5 == 0) tree.sites[pick() % tree.sites.size()].link = static_cast<std::int32_t>(pick()) * 2 - 30;
    }
    const TreeRepair repair = repairTree(tree);
    CHECK(repair.any());
    CHECK(problemOf(tree) == "");
    CHECK(repair.from.size() == tree.links.size());
    const auto method = static_cast<TreeMethod>(seed % 4);
    CHECK(std::isfinite(sway(tree, method, 30)));
  }
}

TEST_CASE("a chain of 20,000 links, 100,000 links on one, and nothing at all are borne") {
  Tree chain = cantilever(20'000, 2'000, 0.5f);
  CHECK_FALSE(repairTree(chain).any());
  CHECK(std::isfinite(sway(chain, TreeMethod::Coupled, 3)));

  Tree brush = cantilever(1, 1, 0.1f);
  brush.links.resize(100'001, brush.links[0]);
  for (std::size_t i = 1; i < brush.links.size(); ++i) {
    Link& link = brush.links[i];
    link.parent = 0;
    link.chain = static_cast<std::int32_t>(i);
    link.radius = 1e-3f;
    link.length = 0.2f;
  }
  std::swap(brush.links.front(), brush.links.back());
  for (Link& link : brush.links) link.parent = link.parent < 0 ? -1 : 100'000;
  CHECK(repairTree(brush).reordered);
  CHECK(std::isfinite(sway(brush, TreeMethod::Analytic, 3)));

  Tree nothing;
  CHECK_FALSE(repairTree(nothing).any());
}
