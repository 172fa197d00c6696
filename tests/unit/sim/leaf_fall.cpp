#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "kernels/leaf_arrays.h"
#include "sim/leaf_storage.h"
#include "support/leaf_scene.h"

using namespace windfall;
using namespace windfall::sim;
using namespace windfall::test;

namespace {

struct Drop {
  double fallTime = 0, deviation = 0, early = 0, late = 0;  ///< s
  double speed = 0;                                         ///< mean over terminal speed
  double rms = 0, median = 0;                               ///< m, horizontal way from start to ground
  double driftX = 0, spreadX = 0;                           ///< m
  std::array<double, kLeafMotions> share{};                 ///< of time
};

/// Lets all leaves of a scene fall in a uniform wind.
Drop drop(const SceneDescription& scene, vec3 wind, float dt = 1.0f / 60) {
  LeafStage stage(scene);
  stage.blow(wind);
  const LeafArrays& a = stage.field.storage().arrays;
  const std::size_t n = stage.field.size();
  std::vector<double> x0(n), z0(n), times(n, 0), ways(n);
  for (std::size_t i = 0; i < n; ++i) x0[i] = static_cast<double>(a.x[i]), z0[i] = static_cast<double>(a.z[i]);
  std::vector<bool> down(n, false);
  Drop drop;
  double total = 0;
  for (int k = 0; stage.field.counts().airborne > 0 && k < 40 * 240; ++k) {
    for (std::size_t i = 0; i < n; ++i) {
      if (stateOf(a.meta[i]) != LeafState::Falling) continue;
      drop.share[motionOf(a.meta[i])] += 1;
      total += 1;
    }
    stage.step(dt);
    for (std::size_t i = 0; i < n; ++i) {
      if (down[i] || stateOf(a.meta[i]) == LeafState::Falling) continue;
      down[i] = true;
      times[i] = stage.time;
      const double dx = static_cast<double>(a.x[i]) - x0[i], dz = static_cast<double>(a.z[i]) - z0[i];
      ways[i] = std::hypot(dx, dz);
      drop.driftX += dx / static_cast<double>(n);
      drop.spreadX += dx * dx / static_cast<double>(n);
      drop.rms += ways[i] * ways[i] / static_cast<double>(n);
      drop.speed += static_cast<double>(scene.leaves.spawnHeight) / times[i] / static_cast<double>(a.speed[i]) /
                    static_cast<double>(n);
    }
  }
  REQUIRE(stage.field.landed() == static_cast<std::int64_t>(n));
  drop.fallTime = stage.field.fallTimeSum() / static_cast<double>(n);
  for (const double t : times) {
    drop.deviation += (t - drop.fallTime) * (t - drop.fallTime) / static_cast<double>(n);
  }
  drop.deviation = std::sqrt(drop.deviation);
  drop.rms = std::sqrt(drop.rms);
  drop.spreadX = std::sqrt(std::max(0.0, drop.spreadX - drop.driftX * drop.driftX));
  std::sort(times.begin(), times.end());
  std::sort(ways.begin(), ways.end());
  drop.early = times[n / 20], drop.late = times[n - 1 - n / 20], drop.median = ways[n / 2];
  for (double& share : drop.share) share /= total;
  return drop;
}

}  // namespace

TEST_CASE("300 leaves from 10 m fall as in the method's Monte Carlo") {
  const Drop few = drop(looseLeaves(300, 10), vec3(0));
  MESSAGE("fall " << few.fallTime << " sd " << few.deviation << " rms " << few.rms << " median " << few.median);
  CHECK(few.fallTime == doctest::Approx(10.2).epsilon(0.03));
  CHECK(std::abs(few.rms - 2.3) < 0.4);
  const Drop many = drop(looseLeaves(6000, 10), vec3(0));
  MESSAGE("fall " << many.fallTime << " sd " << many.deviation << " p5 " << many.early << " p95 " << many.late
                  << " speed " << many.speed << " rms " << many.rms << " median " << many.median);
  MESSAGE("shares " << many.share[0] << " " << many.share[1] << " " << many.share[2] << " " << many.share[3] << " "
                    << many.share[4] << " " << many.share[5]);
  CHECK(many.fallTime == doctest::Approx(10.2).epsilon(0.03));
  CHECK(std::abs(many.deviation - 2.1) < 0.2);
  CHECK(std::abs(many.early - 7.1) < 0.4);
  CHECK(std::abs(many.late - 13.8) < 0.6);
  CHECK(std::abs(many.speed - 0.868) < 0.01);
  CHECK(std::abs(many.rms - 2.3) < 0.4);
  constexpr double kShare[kLeafMotions] = {.05, .12, .09, .13, .32, .30};
  for (std::size_t k = 0; k < kLeafMotions; ++k) CHECK(std::abs(many.share[k] - kShare[k]) < 0.03);
}

TEST_CASE("a wind of 3 m/s carries leaves along, each as long as it falls") {
  const Drop got = drop(looseLeaves(3000, 10), vec3(3, 0, 0));
  MESSAGE("fall " << got.fallTime << " drift " << got.driftX << " spread " << got.spreadX);
  // 3 T - 3 tau, with tau = 0.12 s, and the slide after landing at half speed (0.5 v)^2 / 2 mu g.
  CHECK(std::abs(got.driftX - 3 * got.fallTime + 3 * 0.12) < 0.5);
  CHECK(std::abs(got.driftX - 30.5) < 1.2);
  CHECK(std::abs(got.spreadX - 5.9) < 0.9);
}

TEST_CASE("the wind's part of the velocity relaxes with V/g, 63 % after one time constant") {
  SceneDescription scene = looseLeaves(64, 50);
  LeafStage stage(scene);
  stage.blow(vec3(2, 0, 1));
  const LeafArrays& a = stage.field.storage().arrays;
  for (int k = 0; k < 240; ++k) {
    stage.step(1.0f / 240);
    for (std::size_t i = 0; i < 64; ++i) {
      const double tau = static_cast<double>(a.speed[i]) / 9.81;
      CHECK(static_cast<double>(a.driftX[i]) == doctest::Approx(2 * (1 - std::exp(-stage.time / tau))).epsilon(1e-4));
      CHECK(static_cast<double>(a.driftZ[i]) == doctest::Approx(1 - std::exp(-stage.time / tau)).epsilon(1e-4));
    }
  }
}

TEST_CASE("landing places do not depend on the step's length") {
  const auto land = [](float dt) {
    LeafStage stage(looseLeaves(500, 10));
    while (stage.field.counts().airborne > 0) stage.step(dt);
    const LeafArrays& a = stage.field.storage().arrays;
    std::vector<vec3> places;
    for (std::size_t i = 0; i < stage.field.size(); ++i) places.push_back({a.x[i], a.driftX[i], a.z[i]});
    return std::pair(places, stage.field.fallTimeSum());
  };
  const auto [slow, slowTime] = land(1.0f / 30);
  const auto [fast, fastTime] = land(1.0f / 240);
  double square = 0;
  std::vector<double> apart;
  for (std::size_t i = 0; i < slow.size(); ++i) {
    const double d = std::hypot(slow[i].x - fast[i].x, slow[i].z - fast[i].z);
    apart.push_back(d);
    square += d * d / static_cast<double>(slow.size());
  }
  std::sort(apart.begin(), apart.end());
  MESSAGE("rms " << std::sqrt(square) << " median " << apart[250] << " max " << apart.back());
  CHECK(std::sqrt(square) < 0.05);
  CHECK(slowTime == doctest::Approx(fastTime).epsilon(0.002));
}

TEST_CASE("leaves are never lost, never NaN, never below the ground, and never jump") {
  LeafStage stage(leavesOnPole(2000, 0.95f));
  float lowest = 1, furthest = 0, longest = 0;
  bool conserved = true, finite = true;
  std::vector<LeafInstance> before = stage.show(1);
  for (int k = 0; k < 1200; ++k) {
    const float t = static_cast<float>(k) / 60;
    stage.blow(vec3(6 + 5 * std::sin(0.7f * t), 0.5f * std::sin(2 * t), 4 * std::cos(0.4f * t)));
    stage.step();
    const LeafCounts counts = stage.field.counts();
    conserved = conserved && counts.attached + counts.airborne + counts.grounded == 2000;
    const std::vector<LeafInstance> after = stage.show(1);
    for (std::size_t i = 0; i < after.size(); ++i) {
      const vec3 p = after[i].position;
      finite = finite && std::isfinite(p.x + p.y + p.z);
      longest = std::max(longest, std::abs(glm::dot(after[i].rotation, after[i].rotation) - 1));
      lowest = std::min(lowest, p.y);
      furthest = std::max(furthest, glm::length(p - before[i].position));
    }
    before = after;
  }
  CHECK(conserved);
  CHECK(finite);
  CHECK(longest < 1e-3f);
  CHECK(lowest > -0.045f);  // the petiole's end of a blade that has just touched
  // 11 m/s of wind, 3 of its own, and the petiole's end turning about the middle.
  CHECK(furthest < 0.35f);
  CHECK(stage.field.counts().grounded > 100);
}
