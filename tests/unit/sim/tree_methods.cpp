// The methods beside the coupled one, by the numbers of tree_dynamics.md, 11.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "kernels/link_state.h"
#include "kernels/random.h"
#include "sim/articulated.h"
#include "sim/sample_tree.h"
#include "sim/tree_field.h"

using namespace windfall;
using namespace windfall::sim;

namespace {

struct UniformWind {
  explicit UniformWind(const vec3& velocity) { nodes.fill(vec4(velocity, 0)); }
  WindView view() const {
    WindView view;
    view.velocity = nodes.data();
    view.nx = view.ny = view.nz = 2;
    view.origin = vec3(-50);
    view.perMetre = vec3(0.01f);
    return view;
  }
  std::array<vec4, 8> nodes;
};

TreeField fieldOf(const Tree& tree, const FactorSettings& settings) {
  return TreeField({{std::make_shared<Tree>(tree), {}}}, settings, 1);
}

vec3 tipOf(const TreeField& field, std::size_t link) {
  return placeOf(field.current()[link], vec3(0, 0, 2 * field.shape(link).halfLength));
}

Tree rod(int links) {
  Tree tree = cantilever(links, 3, 0.015f);
  for (Link& link : tree.links) {
    link.windScale = 0;
    link.woodDensity = 900;
  }
  return tree;
}

struct Release {
  double error;      ///< relative rms of the tip
  double frequency;  ///< by the tip's zero crossings, over the reference's
};

/// A rod pulled aside and let go, beside the full nonlinear equations (V4).
Release release(int links, TreeMethod method) {
  const Tree tree = rod(links);
  FactorSettings settings;
  settings.method = method;
  settings.dampingRatio = 0.05;
  settings.implicitness = 0.5;
  settings.gravity = glm::dvec3(0);
  const UniformWind calm(vec3(0));
  const std::vector<LinkBody> bodies = bodiesOf(tree);
  const std::vector<Composite> composites = compositesOf(bodies);
  const double beta = 2 * 0.05 / (2 * std::numbers::pi * firstFrequency(bodies));
  TreeField field = fieldOf(tree, settings);
  ArticulatedTree<double> reference(bodies, beta);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const double angle = 1.5 * (3 - 3.0 * static_cast<double>(i) / links) / bodies[i].stiffness.x;
    field.setJoint(i, vec3(static_cast<float>(angle), 0, 0));
    reference.parts()[i].relative = ArticulatedTree<double>::turned({1, 0, 0, 0}, {angle, 0, 0});
    reference.parts()[i].rotor.z = twistFloor(bodies[i], composites[i]);
  }
  field.pose();
  reference.pose();
  double error = 0, size = 0, last = 0, lastExact = 0, end = 0, endExact = 0;
  int crossings = 0, crossingsExact = 0;
  const auto cross = [](double before, double now, int i, int& count, double& at) {
    if ((before < 0) == (now < 0)) return;
    ++count;
    at = i + before / (before - now);
  };
  for (int i = 0; i < 180; ++i) {
    field.step(calm.view());
    for (int k = 0; k < 30; ++k) reference.stepRungeKutta(1.0 / 1800, [](auto&) {});
    const auto& part = reference.parts().back();
    const glm::dvec3 exact = part.position + part.rotation * glm::dvec3(0, 0, 2 * part.half);
    const double tip = static_cast<double>(tipOf(field, bodies.size() - 1).z);
    error += std::pow(tip - exact.z, 2);
    size += exact.z * exact.z;
    if (i > 0) {
      cross(last, tip, i, crossings, end);
      cross(lastExact, exact.z, i, crossingsExact, endExact);
    }
    last = tip;
    lastExact = exact.z;
  }
  return {std::sqrt(error / size), crossings / end / (crossingsExact / endExact)};
}

}  // namespace

TEST_CASE("V4: calibrated joints sway as the rod does, the published form too fast") {
  for (const int links : {1, 2, 3}) {
    CAPTURE(links);
    const Release calibrated = release(links, TreeMethod::Analytic), literal = release(links, TreeMethod::Literal);
    MESSAGE("links ", links, ": calibrated ", calibrated.error, " at ", calibrated.frequency, ", literal ",
            literal.error, " at ", literal.frequency);
    CHECK(calibrated.error < (links == 1 ? 0.01 : 0.045));
    CHECK(calibrated.frequency == doctest::Approx(1).epsilon(0.01));
    if (links == 1) {
      CHECK(literal.error < 0.01);
    } else {
      CHECK(literal.error > 0.7);
      CHECK(literal.frequency == doctest::Approx(links == 2 ? 1.10 : 1.26).epsilon(0.03));
    }
  }
}

TEST_CASE("V5: the frozen analytic joints never gain energy, over ten decades of stiffness and any step") {
  const UniformWind calm(vec3(0));
  SampleTreeSettings small;
  small.children = {5, 4, 3};
  for (const float stiffness : {1e-5f, 1e-2f, 1.f, 1e2f, 1e5f}) {
    for (const double h : {1.0 / 240, 1.0 / 60, 1.0 / 10, 1.0, 10.0}) {
      CAPTURE(stiffness);
      CAPTURE(h);
      Tree tree = sampleTree(small);
      for (Link& link : tree.links) {
        link.stiffnessScale = stiffness;
        link.windScale = 0;
      }
      FactorSettings settings;
      settings.method = TreeMethod::Analytic;
      settings.h = h;
      settings.dampingRatio = 0;
      settings.gravity = glm::dvec3(0);
      TreeField field = fieldOf(tree, settings);
      RandomSequence random(5);
      for (std::size_t i = 0; i < field.size(); ++i) {
        const auto draw = [&] { return 0.1f * static_cast<float>(random.uniform(-1, 1)); };
        const float x = draw(), y = draw(), z = draw();
        field.setJoint(i, vec3(x, y, z));
      }
      field.pose();
      double last = field.elasticEnergy() + field.kineticEnergy();
      bool grew = false;
      for (int i = 0; i < 60; ++i) {
        field.step(calm.view());
        const double energy = field.elasticEnergy() + field.kineticEnergy();
        // Rounding of single precision a step.
        grew = grew || !(energy <= last * (1 + 2e-6));
        last = energy;
      }
      CHECK_FALSE(grew);
    }
  }
}

TEST_CASE("V6: in steady wind every method but the forces one leans alike, whatever the step") {
  const UniformWind wind(vec3(8, 0, 0));
  SampleTreeSettings small;
  small.children = {6, 5, 3};
  const Tree tree = sampleTree(small);
  vec3 first(0);
  for (const TreeMethod method : {TreeMethod::Coupled, TreeMethod::Analytic, TreeMethod::Literal}) {
    for (const bool moving : {false, true}) {
      if (moving && method != TreeMethod::Analytic) continue;
      for (const double h : {1.0 / 60, 1.0 / 30}) {
        CAPTURE(std::string(nameOf(method)));
        CAPTURE(h);
        FactorSettings settings;
        settings.method = method;
        settings.axisMotion = moving;
        settings.h = h;
        settings.windSpeed = 8;
        TreeField field = fieldOf(tree, settings);
        for (int i = 0; i < static_cast<int>(60 / h); ++i) field.step(wind.view());
        const vec3 tip = tipOf(field, 9);
        if (first == vec3(0)) first = tip;
        CHECK(glm::length(tip - first) < 3e-4f);
      }
    }
  }
  FactorSettings settings;
  settings.method = TreeMethod::Forces;
  TreeField forces = fieldOf(tree, settings);
  for (int i = 0; i < 1200; ++i) forces.step(wind.view());
  // The wind on the crown does not reach its trunk (7).
  CHECK(forces.largestAngle() > 0);
  CHECK(glm::length(tipOf(forces, 9) - first) > 0.02f);
}

TEST_CASE("a force from outside bends every method's tree its way, and lets it go again") {
  const UniformWind calm(vec3(0));
  SampleTreeSettings small;
  small.children = {6, 5, 3};
  for (const TreeMethod method : {TreeMethod::Coupled, TreeMethod::Analytic, TreeMethod::Forces, TreeMethod::Literal}) {
    CAPTURE(std::string(nameOf(method)));
    FactorSettings settings;
    settings.method = method;
    const Tree tree = sampleTree(small);
    std::uint32_t top = 0;
    for (std::uint32_t i = 0; i < tree.links.size(); ++i) top = tree.links[i].order == 0 ? i : top;
    TreeField field = fieldOf(tree, settings);
    const vec3 rest = tipOf(field, top);
    for (int i = 0; i < 300; ++i) {
      const vec3 arm = rotate(field.current()[top].rotation, vec3(0, 0, 2 * field.shape(top).halfLength));
      const LinkForce pull{top, vec3(200, 0, 0), arm};
      field.setForces({&pull, 1});
      field.step(calm.view());
    }
    const float bent = tipOf(field, top).x - rest.x;
    CHECK(bent > 1e-4f);
    for (int i = 0; i < 1800; ++i) field.step(calm.view());
    CHECK(glm::length(tipOf(field, top) - rest) < 0.05f * bent + 1e-5f);
  }
}
