#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "kernels/leaf_hang.h"
#include "support/leaf_scene.h"

using namespace windfall;
using namespace windfall::sim;
using namespace windfall::test;

namespace {

/// Share of 2000 leaves that has come loose.
double lost(float season, vec3 wind, double seconds, float dt = 1.0f / 60) {
  LeafStage stage(leavesOnPole(2000, season));
  stage.blow(wind);
  while (stage.time < seconds) stage.step(dt);
  return 1 - stage.field.counts().attached / 2000.0;
}

float degreesBetween(const vec4& a, const vec4& b) {
  return 2 * std::acos(std::min(1.0f, std::abs(glm::dot(a, b)))) * 180 / std::numbers::pi_v<float>;
}

}  // namespace

TEST_CASE("the load on a petiole has the method's numbers") {
  // 30 cm2: weight 5 mN, drag 10 mN at 5 m/s, 24 at 10, 52 at 20.
  const vec3 afloat(0, -9.81f, 0);  // falls freely: no weight
  CHECK(petioleLoad(0.003f, vec3(0), vec3(0)) == doctest::Approx(0.0053).epsilon(0.01));
  CHECK(petioleLoad(0.003f, vec3(5, 0, 0), afloat) == doctest::Approx(0.0095).epsilon(0.02));
  CHECK(petioleLoad(0.003f, vec3(10, 0, 0), afloat) == doctest::Approx(0.024).epsilon(0.02));
  CHECK(petioleLoad(0.003f, vec3(20, 0, 0), afloat) == doctest::Approx(0.052).epsilon(0.02));
  CHECK(petioleStrength(0) == doctest::Approx(2));
  CHECK(petioleStrength(0.8f) == doctest::Approx(0.0166).epsilon(0.01));
  CHECK(petioleStrength(1) == doctest::Approx(0.005));
  // At its strength a petiole holds for a second; at 0.3 of it for two minutes.
  CHECK(releaseChance(1, 1, 1) == doctest::Approx(1 - std::exp(-1.0)));
  CHECK(releaseChance(0.3f, 1, 120) == doctest::Approx(1 - std::exp(-0.97)).epsilon(0.01));
}

TEST_CASE("in summer nothing falls, even at 30 m/s") { CHECK(lost(0, vec3(30, 0, 0), 60) == 0); }

TEST_CASE("at the end of the season leaves drop in calm air") {
  CHECK(lost(1, vec3(0), 10) > 0.7);
  CHECK(lost(1, vec3(0), 60) > 0.9);
}

TEST_CASE("late in the season calm keeps the leaves and gusts strip them") {
  const double calm = lost(0.8f, vec3(0), 20), breeze = lost(0.8f, vec3(5, 0, 0), 20),
               gale = lost(0.8f, vec3(15, 0, 0), 20);
  MESSAGE("lost in 20 s: calm " << calm << ", 5 m/s " << breeze << ", 15 m/s " << gale);
  CHECK(calm < 0.4);
  CHECK(breeze > calm + 0.1);
  CHECK(gale > 0.9);
}

TEST_CASE("large leaves tear off no sooner than small ones") {
  const auto lostOfSize = [](float size) {
    SceneDescription scene = leavesOnPole(2000, 0.8f);
    auto tree = std::make_shared<Tree>(*scene.trees[0].tree);
    for (LeafSite& site : tree->sites) site.size = size;
    scene.trees[0].tree = tree;
    LeafStage stage(scene);
    stage.blow(vec3(5, 0, 0));
    while (stage.time < 10) stage.step(1.0f / 60);
    return 1 - stage.field.counts().attached / 2000.0;
  };
  const double small = lostOfSize(0.05f);
  CHECK(small > 0.1);
  CHECK(std::abs(lostOfSize(0.25f) - small) < 0.01);
}

TEST_CASE("how many come loose does not depend on the step's length") {
  const vec3 wind(7, 0, 0);
  CHECK(std::abs(lost(0.8f, wind, 6, 1.0f / 30) - lost(0.8f, wind, 6, 1.0f / 240)) < 0.035);
}

TEST_CASE("a leaf leaves its twig with the twig's velocity and turns into its fall without a jump") {
  LeafStage stage(leavesOnPole(300, 1));
  stage.blow(vec3(2, 0, 1));
  // The pole swings about its foot.
  const auto swing = [&](double time, LinkState& state) {
    const auto angle = static_cast<float>(0.2 * std::sin(4 * time));
    const vec4 up{-0.70710678f, 0, 0, 0.70710678f};
    state.rotation = compose(turnAbout({0, 0, 1}, angle / kTwoPi), up);
    state.angularVelocity = vec3(0, 0, static_cast<float>(0.8 * std::cos(4 * time)));
  };
  swing(0, stage.now[0]);
  float jump = 0, turned = 0, acceleration = 0;
  int released = 0;
  std::vector<LeafInstance> before = stage.show(1), earlier = before;
  for (int k = 0; k < 240; ++k) {
    stage.before = stage.now;
    swing(stage.time + 1.0 / 60, stage.now[0]);
    stage.step();
    // Where the last interval ended, the next begins.
    const std::vector<LeafInstance> start = stage.show(0), end = stage.show(1);
    for (std::size_t i = 0; i < start.size(); ++i) {
      if (k == 0 || start[i].state > 1) continue;
      const auto middle = [](const LeafInstance& leaf) {
        return leaf.position + rotate(leaf.rotation, vec3(0, 0.5f * leaf.size, 0));
      };
      jump = std::max(jump, glm::length(middle(start[i]) - middle(before[i])));
      turned = std::max(turned, degreesBetween(start[i].rotation, before[i].rotation));
      if (end[i].state == 1 && before[i].state == 0) {
        ++released;
        const vec3 v0 = middle(before[i]) - middle(earlier[i]), v1 = middle(end[i]) - middle(start[i]);
        acceleration = std::max(acceleration, glm::length(v1 - v0) * 3600);
      }
    }
    earlier = before;
    before = end;
  }
  MESSAGE(released << " released; largest jump " << jump << " m, " << turned << " degrees, " << acceleration
                   << " m/s2");
  CHECK(released > 100);
  CHECK(jump < 2e-4f);
  CHECK(turned < 0.6f);  // 0.25 of it is the packing
  // Gravity, and the drag of 2 m/s of wind on a leaf whose speed relaxes in 0.1 s.
  CHECK(acceleration < 60);
}

TEST_CASE("a falling leaf's velocity and turn do not jump when its motion changes or it lands") {
  const float dt = 1.0f / 240;
  SceneDescription scene = looseLeaves(400, 6);
  scene.solver.step = dt;
  LeafStage stage(scene);
  std::vector<LeafInstance> before = stage.show(1);
  float turned = 0, changed = 0;
  std::vector<vec3> last(before.size(), vec3(0));
  for (int k = 0; k < 2400; ++k) {
    stage.step(dt);
    const std::vector<LeafInstance> after = stage.show(1);
    for (std::size_t i = 0; i < after.size(); ++i) {
      turned = std::max(turned, degreesBetween(after[i].rotation, before[i].rotation));
      const auto middle = [](const LeafInstance& leaf) {
        return leaf.position + rotate(leaf.rotation, vec3(0, 0.5f * leaf.size, 0));
      };
      const vec3 velocity = (middle(after[i]) - middle(before[i])) / dt;
      if (k > 0 && after[i].state == 1) changed = std::max(changed, glm::length(velocity - last[i]));
      last[i] = velocity;
    }
    before = after;
  }
  MESSAGE("largest turn in a step " << turned << " degrees, largest change of velocity " << changed << " m/s");
  // Six turns a second with +-65 % are 15 degrees a step of 1/240 s, and a half turn that fades in 0.25 s adds 4.
  CHECK(turned < 19);
  // The table's accelerations are below 70 m/s2 for the quickest leaf.
  CHECK(changed < 0.45f);
}
