// V7 of tree_dynamics.md, 11: ten minutes of gusts on 10,000 links, and a wind ten times as strong.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "sim/engine.h"
#include "sim/sample_tree.h"

using namespace windfall::sim;

namespace {

std::unique_ptr<Engine> engineOf(TreeMethod method, bool moving, float speed) {
  SceneDescription scene;
  SampleTreeSettings tree = tenThousandLinks();
  tree.sitesPerLink = 0;
  scene.trees.push_back({std::make_shared<Tree>(sampleTree(tree)), {}});
  scene.leaves.count = 0;
  scene.solver.step = 1.f / 30;
  scene.solver.method = method;
  scene.solver.axisMotion = moving;
  scene.wind.speed = speed;
  scene.wind.gustStrength = 1.5f;
  auto engine = Engine::create(scene, Device::Cpu, 1);
  REQUIRE(engine);
  return std::move(*engine);
}

struct Case {
  TreeMethod method;
  bool moving;
  float largest;  ///< rad that no joint may pass in the note's gusts
};
std::string called(const Case& one) {
  return std::string(nameOf(one.method)) + (one.moving ? " with moving bases" : "");
}
constexpr Case kCases[] = {{TreeMethod::Coupled, false, 0.87f},
                           {TreeMethod::Analytic, false, 0.79f},
                           {TreeMethod::Analytic, true, 1.52f},
                           {TreeMethod::Literal, false, 0.75f},
                           {TreeMethod::Forces, false, 0.75f}};

}  // namespace

TEST_CASE("V7: ten minutes of gusts keep 10,000 links in bounds and the sway as it is") {
  for (const Case& one : kCases) {
    CAPTURE(called(one));
    const auto engine = engineOf(one.method, one.moving, 8);
    double minute[10] = {};
    float largest = 0;
    bool finite = true;
    for (int i = 0; i < 18000; ++i) {
      engine->step();
      if (i % 10 != 0) continue;
      const Statistics s = engine->statistics();
      finite = finite && std::isfinite(s.largestAngle) && std::isfinite(s.kineticEnergy);
      largest = std::max(largest, s.largestAngle);
      minute[i / 1800] += std::pow(static_cast<double>(s.tipDisplacement), 2) / 180;
    }
    CHECK(finite);
    CHECK(largest < one.largest);
    MESSAGE(called(one), ": largest angle ", largest, " rad, rms of the tip in minute 2: ", std::sqrt(minute[1]),
            " m, in minute 10: ", std::sqrt(minute[9]));
    for (int m = 1; m < 10; ++m) CHECK(std::sqrt(minute[m]) == doctest::Approx(std::sqrt(minute[1])).epsilon(0.12));
  }
}

TEST_CASE("V7: a wind of 80 m/s is borne") {
  for (const Case& one : kCases) {
    CAPTURE(called(one));
    const auto engine = engineOf(one.method, one.moving, 80);
    float largest = 0;
    for (int i = 0; i < 600; ++i) {
      engine->step();
      const float angle = engine->statistics().largestAngle;
      CHECK(std::isfinite(angle));
      largest = std::max(largest, angle);
    }
    MESSAGE(called(one), ": largest angle ", largest, " rad");
    // With fronts to 200 m/s; in the note's wind its prefactored method reached 3.2, and a joint shows 1.5 at most. The
    // forces method has no bound of its own, and the note none for it.
    CHECK(largest < (one.method == TreeMethod::Forces ? 10 : 4));
  }
}
