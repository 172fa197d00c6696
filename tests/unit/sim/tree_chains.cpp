// V3 and V4 of tree_dynamics.md, 11: rods of a few links beside the full nonlinear equations.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "kernels/link_state.h"
#include "sim/sample_tree.h"
#include "sim/tree_field.h"
#include "support/reference_tree.h"
#include "support/uniform_wind.h"

using namespace windfall;
using namespace windfall::sim;
using windfall::test::AirBrake;
using windfall::test::ReferenceTree;
using windfall::test::UniformWind;

namespace {

enum class Load { Release, Wind };
constexpr int kFrames = 180;       // three seconds
constexpr int kFine = 16;          // reference tips a frame
constexpr double kLength = 3;      // m
constexpr double kPull = 1.5;      // N at the tip, let go at the start
constexpr float kWind = 5;         // m/s, from the start on
constexpr double kDamping = 0.05;  // ratio of the first mode

/// A rod and its reference motion: the tip along z, 960 times a second.
struct Rod {
  int links;
  Load load;
  Tree tree;
  FactorSettings settings;
  std::vector<double> tips;

  Rod(int count, Load how) : links(count), load(how), tree(cantilever(count, kLength, 0.015f)) {
    for (Link& link : tree.links) {
      link.windScale = load == Load::Wind ? 1 : 0;
      link.woodDensity = 900;
    }
    settings.dampingRatio = kDamping;
    settings.gravity = glm::dvec3(0);
    settings.windSpeed = load == Load::Wind ? static_cast<double>(kWind) : 0;
    settings.windDirection = {0, 0, 1};
    ReferenceTree reference(tree, settings, AirBrake::Linear);
    for (std::size_t i = 0; i < reference.size(); ++i) reference.setJoint(i, startAngle(i));
    reference.pose();
    const glm::dvec3 air(0, 0, load == Load::Wind ? static_cast<double>(kWind) : 0);
    // Stiffness damps the highest modes so much that only short steps bear them.
    const int parts = links > 3 ? 40 : 12;
    for (int i = 0; i < kFrames * kFine; ++i) {
      for (int k = 0; k < parts; ++k) reference.stepRungeKutta(1.0 / (60 * kFine * parts), [&](auto&) { return air; });
      tips.push_back(reference.tip(reference.size() - 1).z);
    }
  }

  glm::dvec3 startAngle(std::size_t link) const {
    if (load == Load::Wind) return glm::dvec3(0);
    const double lever = kLength - kLength * static_cast<double>(link) / links;
    return {kPull * lever / bodiesOf(tree)[link].stiffness.x, 0, 0};
  }
};

struct Motion {
  double error;      ///< rms of the tip's error over that of its motion
  double frequency;  ///< by the tip's zero crossings, over the reference's
};

/// What the tip's motion is measured about: where the load would hold it.
double middleOf(const Rod& rod) {
  double sum = 0;
  for (const double tip : rod.tips) sum += tip;
  return rod.load == Load::Wind ? sum / static_cast<double>(rod.tips.size()) : 0;
}

/// The rod by a method, with `fine` steps in 1/960 s taken as one.
Motion moved(const Rod& rod, FactorSettings settings, int fine = kFine) {
  settings.h = fine / (60.0 * kFine);
  TreeField field({{std::make_shared<Tree>(rod.tree), {}}}, settings, 1);
  for (std::size_t i = 0; i < field.size(); ++i) field.setJoint(i, vec3(rod.startAngle(i)));
  field.pose();
  const UniformWind wind(vec3(0, 0, rod.load == Load::Wind ? kWind : 0));
  double error = 0, size = 0, last = 0, lastExact = 0, end = 0, endExact = 0;
  int crossings = 0, crossingsExact = 0;
  const auto cross = [](double before, double now, std::size_t i, int& count, double& at) {
    if ((before < 0) == (now < 0)) return;
    ++count;
    at = static_cast<double>(i) + before / (before - now);
  };
  const auto step = static_cast<std::size_t>(fine);
  const double middle = middleOf(rod);
  for (std::size_t i = step; i <= rod.tips.size(); i += step) {
    field.step(wind.view());
    const float length = 2 * field.shape(field.size() - 1).halfLength;
    const double exact = rod.tips[i - 1];
    const double tip = static_cast<double>(placeOf(field.current()[field.size() - 1], vec3(0, 0, length)).z);
    error += (tip - exact) * (tip - exact);
    size += (exact - middle) * (exact - middle);
    if (i > step) {
      cross(last, tip, i, crossings, end);
      cross(lastExact, exact, i, crossingsExact, endExact);
    }
    last = tip;
    lastExact = exact;
  }
  return {std::sqrt(error / size), crossingsExact > 0 ? crossings / end / (crossingsExact / endExact) : 0};
}

Motion moved(const Rod& rod, TreeMethod method) {
  FactorSettings settings = rod.settings;
  settings.method = method;
  return moved(rod, settings);
}

FactorSettings coupled(const Rod& rod, double implicitness, bool compensate = true) {
  FactorSettings settings = rod.settings;
  settings.implicitness = implicitness;
  settings.compensate = compensate;
  return settings;
}

}  // namespace

TEST_CASE("V3: the reference keeps the energy of a swinging chain") {
  Tree tree = cantilever(2, 3, 0.015f);
  for (Link& link : tree.links) link.windScale = 0;
  FactorSettings settings;
  settings.dampingRatio = 0;
  settings.twistFloor = false;
  ReferenceTree chain(tree, settings, AirBrake::Relative);
  chain.dropPreStress();
  // In one plane: of a joint that bends and twists at once K theta is the springs' torque to second order only.
  chain.setJoint(0, {0.3, 0, 0});
  chain.setJoint(1, {-0.5, 0, 0});
  chain.pose();
  const double start = chain.energy();
  double drift = 0;
  for (int i = 0; i < 20'000; ++i) {
    chain.stepRungeKutta(5e-5, [](auto&) { return glm::dvec3(0); });
    if (i % 100 == 0) drift = std::max(drift, std::abs(chain.energy() - start) / std::abs(start));
  }
  MESSAGE("relative drift in a second: ", drift);
  CHECK(drift < 3e-10);
}

TEST_CASE("V4: rods of 1, 2, 3 and 10 links move as the full equations say; the published form sways too fast") {
  for (const Load load : {Load::Release, Load::Wind}) {
    for (const int links : {1, 2, 3, 10}) {
      const Rod rod(links, load);
      const Motion calibrated = moved(rod, TreeMethod::Analytic), literal = moved(rod, TreeMethod::Literal);
      const Motion half = moved(rod, coupled(rod, 0.5)), usual = moved(rod, coupled(rod, 0.6));
      CAPTURE(links);
      CAPTURE(load == Load::Wind);
      MESSAGE(links, std::string(load == Load::Wind ? " links, wind" : " links, let go"), ": literal ", literal.error,
              " (x", literal.frequency, "), calibrated ", calibrated.error, " (x", calibrated.frequency, "), coupled ",
              half.error, " (x", half.frequency, "), coupled 0.6 ", usual.error);
      CHECK(calibrated.error < (links == 1 ? 0.0015 : load == Load::Wind ? 0.022 : 0.04));
      CHECK(half.error < 0.02);
      CHECK(usual.error < 0.05);
      if (links == 1) {
        CHECK(literal.error < 0.0015);
      } else {
        CHECK(literal.error > 0.65);
      }
      if (load == Load::Wind) continue;
      CHECK(calibrated.frequency == doctest::Approx(1).epsilon(0.005));
      CHECK(half.frequency == doctest::Approx(1).epsilon(0.005));
      // +10, +26 % and, of the many modes of ten links, 80 % and more: 0.7 sqrt(n) is the root joint's own.
      const double tooFast = links == 1 ? 1.0 : links == 2 ? 1.10 : links == 3 ? 1.26 : 2.0;
      CHECK(literal.frequency == doctest::Approx(tooFast).epsilon(links > 3 ? 0.1 : 0.03));
    }
  }
}

TEST_CASE("V4: the coupled solver converges with its step; backward Euler alone would damp twice as much") {
  const Rod rod(3, Load::Release);
  double last = 1;
  for (const int fine : {16, 8, 4, 2, 1}) {
    const double error = moved(rod, coupled(rod, 0.5), fine).error;
    MESSAGE("step 1/", 960 / fine, " s: ", error);
    CHECK(error < last);
    last = error;
    if (fine == 2) CHECK(error < 8e-4);
  }
  CHECK(last < 4e-4);
  const double euler = moved(rod, coupled(rod, 1, false)).error;
  MESSAGE("backward Euler, uncompensated: ", euler);
  CHECK(euler > 0.3);
  CHECK(euler < 0.5);
}
