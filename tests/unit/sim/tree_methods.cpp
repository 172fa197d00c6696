// The methods beside the coupled one, by the numbers of tree_dynamics.md, 11.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "kernels/link_state.h"
#include "kernels/random.h"
#include "sim/sample_tree.h"
#include "sim/tree_field.h"
#include "support/uniform_wind.h"

using namespace windfall;
using namespace windfall::sim;
using windfall::test::UniformWind;

namespace {

TreeField fieldOf(const Tree& tree, const FactorSettings& settings) {
  return TreeField({{std::make_shared<Tree>(tree), {}}}, settings, 1);
}

vec3 tipOf(const TreeField& field, std::size_t link) {
  return placeOf(field.current()[link], vec3(0, 0, 2 * field.shape(link).halfLength));
}

}  // namespace

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
