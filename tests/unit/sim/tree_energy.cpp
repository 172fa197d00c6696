// V5 of tree_dynamics.md, 11, in double precision: no method that ships gains energy, and the published form does.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "kernels/random.h"
#include "sim/sample_tree.h"
#include "support/exact_tree.h"
#include "support/moving_inertia.h"

using namespace windfall;
using namespace windfall::sim;
using windfall::test::ExactTree;
using windfall::test::MovingInertiaTree;

namespace {

constexpr float kStiffness[] = {1e-5f, 1e-2f, 1, 1e2f, 1e5f};
constexpr double kSteps[] = {1.0 / 240, 1.0 / 60, 1.0 / 30, 0.1, 1, 10};

Tree treeOf(float stiffness) {
  SampleTreeSettings settings;
  settings.children = {5, 4, 3};
  Tree tree = sampleTree(settings);
  for (Link& link : tree.links) {
    link.stiffnessScale = stiffness;
    link.windScale = 0;
  }
  return tree;
}

glm::dvec3 startAngle(std::size_t link) {
  const auto draw = [&](std::uint32_t axis) {
    return 0.2 * static_cast<double>(uniform(5, static_cast<std::uint32_t>(link), axis)) - 0.1;
  };
  return {draw(0), draw(1), draw(2)};
}

struct Growth {
  double largest = -1;  ///< of a step, relative
  double whole = 0;     ///< of all steps, relative
};

Growth growthOf(const Tree& tree, const FactorSettings& settings, int steps) {
  ExactTree exact(tree, settings);
  for (std::size_t i = 0; i < exact.size(); ++i) exact.setJoint(i, startAngle(i));
  exact.pose();
  const double start = exact.elasticEnergy() + exact.kineticEnergy();
  double last = start;
  Growth growth;
  for (int i = 0; i < steps; ++i) {
    exact.step([](auto&) { return glm::dvec3(0); });
    const double energy = exact.elasticEnergy() + exact.kineticEnergy();
    if (last > 1e-250 * start) growth.largest = std::max(growth.largest, energy / last - 1);
    if (!std::isfinite(energy)) growth.largest = 1;
    last = energy;
  }
  growth.whole = last / start - 1;
  return growth;
}

FactorSettings undamped(TreeMethod method, double h) {
  FactorSettings settings;
  settings.method = method;
  settings.h = h;
  settings.dampingRatio = 0;
  settings.gravity = glm::dvec3(0);
  return settings;
}

}  // namespace

TEST_CASE("V5: in double precision energy stays to the last digits, over ten decades of stiffness and any step") {
  double frozen = -1, half = -1, usual = -1;
  for (const float stiffness : kStiffness) {
    const Tree tree = treeOf(stiffness);
    for (const double h : kSteps) {
      CAPTURE(stiffness);
      CAPTURE(h);
      for (const TreeMethod method : {TreeMethod::Analytic, TreeMethod::Literal}) {
        frozen = std::max(frozen, growthOf(tree, undamped(method, h), 60).largest);
      }
      FactorSettings coupled = undamped(TreeMethod::Coupled, h);
      coupled.implicitness = 0.5;
      half = std::max(half, growthOf(tree, coupled, 60).largest);
      coupled.implicitness = 0.6;
      const Growth strict = growthOf(tree, coupled, 60);
      CHECK(strict.largest < 0);
      usual = std::max(usual, strict.whole);
    }
  }
  MESSAGE("largest relative growth in a step: frozen joints ", frozen, ", coupled 0.5 ", half,
          "; coupled 0.6 over 60 steps ", usual);
  CHECK(frozen <= 1e-14);
  CHECK(half <= 1.2e-12);
}

TEST_CASE("V5: inertias of the current pose pump energy without end; the guard of the energy stops that") {
  const Tree tree = treeOf(1);
  for (const double h : {1.0 / 240, 1.0 / 60, 1.0 / 30, 0.1}) {
    CAPTURE(h);
    double energies[2] = {}, start = 0, grown = 0;
    for (const bool guarded : {false, true}) {
      MovingInertiaTree moving(tree, guarded);
      for (std::size_t i = 0; i < moving.size(); ++i) moving.setAngle(i, startAngle(i));
      double last = start = moving.step(h);
      for (int i = 0; i < 600 || (!guarded && i < 6000); ++i) {
        const double energy = moving.step(h);
        if (guarded) grown = std::max(grown, energy / last - 1);
        last = energy;
        if (!(energy < 1e150)) break;
      }
      energies[guarded ? 1 : 0] = last;
    }
    MESSAGE("step ", h, " s: unguarded ", energies[0] / start, " times the energy, guarded ", energies[1] / start);
    CHECK_FALSE(energies[0] <= 1e100 * start);
    CHECK(energies[1] <= start);
    CHECK(grown <= 1e-14);
  }
}

TEST_CASE("V6: in double precision springs carry the loads of a steady wind to the last digits") {
  SampleTreeSettings small;
  small.children = {6, 5, 3};
  Tree tree = sampleTree(small);
  // So few twigs would have to carry ten times the leaves of real ones.
  for (Link& link : tree.links) link.leafArea *= 0.1f;
  glm::dvec3 first(0);
  for (const TreeMethod method : {TreeMethod::Coupled, TreeMethod::Analytic, TreeMethod::Literal}) {
    for (const double h : {1.0 / 60, 0.1, 1.0}) {
      CAPTURE(std::string(nameOf(method)));
      CAPTURE(h);
      FactorSettings settings;
      settings.method = method;
      settings.h = h;
      settings.windSpeed = 8;
      ExactTree exact(tree, settings);
      // Until all is at rest: some minutes.
      const double seconds = h < 0.05 ? 120 : 900;
      for (int i = 0; i < static_cast<int>(seconds / h); ++i) {
        exact.step([](auto&) { return glm::dvec3(8, 0, 0); });
      }
      // Loads of the pose, summed by themselves.
      const std::size_t n = exact.size();
      std::vector<glm::dvec3> force(n), torque(n);
      double difference = 0, total = 0;
      for (std::size_t i = n; i-- > 0;) {
        const LinkBody& body = exact.bodies()[i];
        const glm::dvec3 along = exact.turn(i) * glm::dvec3(0, 0, 1);
        const V3<double> drag = dragOf<double>(body.woodDrag, body.leafDrag, {along.x, along.y, along.z}, {8, 0, 0});
        const glm::dvec3 own = glm::dvec3(drag.x, drag.y, drag.z) + body.mass * settings.gravity;
        force[i] += own;
        torque[i] += glm::cross(along * (0.5 * body.length), own);
        glm::dquat frame = body.rotation;
        if (body.parent >= 0) {
          const auto p = static_cast<std::size_t>(body.parent);
          force[p] += force[i];
          torque[p] += torque[i] + glm::cross(exact.place(i) - exact.place(p), force[i]);
          frame = exact.turn(p) * (glm::conjugate(exact.bodies()[p].rotation) * body.rotation);
        }
        const glm::dvec3 rest(exact.constant(i, kPreStress), exact.constant(i, kPreStress + 1),
                              exact.constant(i, kPreStress + 2));
        glm::dvec3 local = glm::conjugate(glm::normalize(frame)) * torque[i] - rest;
        const double q = glm::length(local / body.stiffness) / static_cast<double>(LinkStep<float>().saturation);
        local *= std::pow(1 + q * q * q * q, -0.25);
        const glm::dvec3 off = body.stiffness * exact.angle(i) - local;
        difference += glm::dot(off, off);
        total += glm::dot(local, local);
      }
      MESSAGE(std::string(nameOf(method)), ", step ", h, " s: ", std::sqrt(difference / total));
      CHECK(std::sqrt(difference / total) < (h < 0.05 ? 1e-8 : 1e-12));
      if (first == glm::dvec3(0)) first = exact.tip(9);
      CHECK(glm::length(exact.tip(9) - first) < 1e-6);
    }
  }
}
