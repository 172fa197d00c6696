// Constants that are made anew beside the steps: for another wind, and for leaves that have fallen.
#include <doctest/doctest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "sim/cpu_engine.h"
#include "sim/sample_tree.h"
#include "sim/tree_field.h"
#include "support/uniform_wind.h"

using namespace windfall;
using namespace windfall::sim;
using windfall::test::UniformWind;

namespace {

struct Way {
  TreeMethod method;
  bool moving;
};
constexpr Way kWays[] = {{TreeMethod::Coupled, false},
                         {TreeMethod::Analytic, false},
                         {TreeMethod::Analytic, true},
                         {TreeMethod::Forces, false},
                         {TreeMethod::Literal, false}};

std::vector<TreeInstance> forest() {
  const auto large = std::make_shared<Tree>(sampleTree());
  const auto rod = std::make_shared<Tree>(cantilever(40, 3, 0.02f));
  return {{large, {}}, {rod, {vec3(3, 0, 1), 1}}, {large, {vec3(8, 0, 0), 2}}};
}

FactorSettings settingsOf(const Way& way) {
  FactorSettings settings;
  settings.method = way.method;
  settings.axisMotion = way.moving;
  settings.windSpeed = 4;
  return settings;
}

/// A share of each link's leaves.
std::vector<float> lostOf(const TreeField& field, float share) {
  std::vector<float> lost;
  for (const TreeInstance& instance : field.trees()) {
    for (const Link& link : instance.tree->links) lost.push_back(share * link.leafArea);
  }
  return lost;
}

/// Steps until the constants are taken; how many that were.
std::size_t finish(TreeField& field, const WindView& wind) {
  std::size_t steps = 0;
  for (; field.isRenewing() && steps < 1000; ++steps) field.step(wind);
  return steps;
}

SceneDescription gusts() {
  SceneDescription scene;
  scene.trees = forest();
  scene.wind.speed = 10;
  scene.wind.course = WindCourse::Curve;
  scene.wind.curve = {{0, 0.2f, 0}, {2, 2, 30}, {4, 0.2f, -60}};
  scene.leaves.count = 2000;
  scene.leaves.season = 0.8f;
  return scene;
}

class WatchedEngine : public CpuEngine {
 public:
  using CpuEngine::CpuEngine;
  using CpuEngine::trees;
};

}  // namespace

TEST_CASE("constants made beside the steps are those made at once, to the last bit") {
  const UniformWind wind(vec3(6, 0, 1));
  for (const Way& way : kWays) {
    CAPTURE(std::string(nameOf(way.method)));
    TreeField field(forest(), settingsOf(way), 2);
    FactorSettings windy = field.settings();
    windy.windSpeed = 13;
    windy.windDirection = glm::dvec3(0, 0, 1);
    const std::vector<float> lost = lostOf(field, 0.5f);
    TreeField other(forest(), windy, 1);
    other.setLostArea(lost);

    const std::vector<float> before(field.constants().begin(), field.constants().end());
    field.renew(windy, lost);
    field.step(wind.view());
    CHECK(field.isRenewing());
    CHECK(std::equal(before.begin(), before.end(), field.constants().begin()));
    CHECK(field.settings().windSpeed == 4);
    const std::size_t steps = 1 + finish(field, wind.view());
    CHECK(steps > 1);
    CHECK(steps <= TreeField::kFactorSteps + 1);
    CHECK(field.settings().windSpeed == 13);
    CHECK(std::equal(field.constants().begin(), field.constants().end(), other.constants().begin()));
    CHECK(std::equal(lost.begin(), lost.end(), field.lostArea().begin()));
  }
}

TEST_CASE("neither lost leaves nor another stiffness make a joint jump") {
  const UniformWind wind(vec3(7, 0, 2));
  for (const Way& way : kWays) {
    CAPTURE(std::string(nameOf(way.method)));
    TreeField field(forest(), settingsOf(way), 1);
    for (int i = 0; i < 40; ++i) field.step(wind.view());
    const auto largestMove = [&] {
      std::vector<vec3> angles;
      for (std::size_t i = 0; i < field.size(); ++i) angles.push_back(field.angle(i));
      field.step(wind.view());
      float largest = 0;
      for (std::size_t i = 0; i < field.size(); ++i) {
        largest = std::max(largest, glm::length(field.angle(i) - angles[i]));
      }
      return largest;
    };
    float usual = 0;
    for (int i = 0; i < 30; ++i) usual = std::max(usual, largestMove());
    // As much as falls before a tree hears of it: other masses, hardly another wind.
    field.renew(field.settings(), lostOf(field, 0.03f));
    float atLoss = 0;
    while (field.isRenewing()) atLoss = std::max(atLoss, largestMove());
    CHECK(atLoss < 2 * usual + 1e-3f);

    Tree stiffer = *field.trees()[0].tree;
    for (Link& link : stiffer.links) link.stiffnessScale = 1.5f;
    field.setTree(0, std::make_shared<Tree>(stiffer));
    CHECK(largestMove() < 3 * usual + 5e-3f);
  }
}

TEST_CASE("trees that are edited while constants are made come into them") {
  const UniformWind wind(vec3(6, 0, 1));
  TreeField field(forest(), settingsOf(kWays[0]), 1);
  FactorSettings windy = field.settings();
  windy.windSpeed = 13;
  field.renew(windy, field.lostArea());
  for (int i = 0; i < 5; ++i) field.step(wind.view());
  Tree stiffer = *field.trees()[0].tree;
  for (Link& link : stiffer.links) link.stiffnessScale = 4;
  field.setTree(0, std::make_shared<Tree>(stiffer));
  CHECK(field.isRenewing());
  finish(field, wind.view());
  TreeField other(field.trees(), windy, 1);
  CHECK(std::equal(field.constants().begin(), field.constants().end(), other.constants().begin()));
}

TEST_CASE("with gusts and lost leaves the bits are the same for any number of threads, and after a saved state") {
  WatchedEngine one(gusts(), 1), two(gusts(), 2);
  bool saved = false;
  std::vector<std::uint8_t> bytes;
  int left = -1;
  for (int i = 0; i < 200; ++i) {
    one.step();
    two.step();
    // In the middle of new constants for a wind that has risen.
    if (!saved && one.trees().isRenewing() && one.trees().renewal().pieces == 3 && one.time() > 1.5) {
      bytes = one.save();
      saved = true;
      left = 199 - i;
    }
  }
  CHECK(one.hash() == two.hash());
  REQUIRE(saved);
  WatchedEngine other(gusts(), 2);
  REQUIRE(other.restore(bytes));
  CHECK(other.save() == bytes);
  for (int i = 0; i < left; ++i) other.step();
  CHECK(other.hash() == one.hash());
  CHECK(other.save() == one.save());
}
