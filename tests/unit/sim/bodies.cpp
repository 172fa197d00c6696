#include "sim/bodies.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "sim/sample_tree.h"

using namespace windfall;
using namespace windfall::sim;

namespace {

/// First bending frequency of a clamped uniform beam (Euler and Bernoulli), Hz.
double beamFrequency(double length, double radius, double modulus, double density) {
  return 3.5160152685 / (2 * std::numbers::pi) * std::sqrt(modulus * radius * radius / 4 / density) / (length * length);
}

}  // namespace

TEST_CASE("a cantilever of n links has the frequencies of the method's table") {
  const double beam = beamFrequency(3, 0.015, 6e9, 950);
  const struct {
    int links;
    double ratio;
  } table[] = {{1, 0.697}, {2, 0.898}, {3, 0.952}, {5, 0.982}, {10, 0.995}, {20, 0.999}};
  for (const auto& row : table) {
    CAPTURE(row.links);
    CHECK(firstFrequency(cantilever(row.links, 3, 0.015f)) / beam == doctest::Approx(row.ratio).epsilon(0.0011));
  }
}

TEST_CASE("frequency follows the root of the stiffness and does not see where a tree stands") {
  Tree tree = sampleTree();
  const double f = firstFrequency(tree);
  for (Link& link : tree.links) link.stiffnessScale = 4;
  CHECK(firstFrequency(tree) == doctest::Approx(2 * f).epsilon(1e-5));
  CHECK(firstFrequency(bodiesOf(tree, {vec3(100, 0, 50), 2.0f})) == doctest::Approx(2 * f).epsilon(1e-5));
}

TEST_CASE("the sample broadleaf has the mass and the sway of the method's table") {
  const SampleTreeSettings settings;
  const Tree tree = sampleTree(settings);
  CHECK(tree.links.size() == 1906);
  CHECK(totalMass(tree) > 150);
  CHECK(totalMass(tree) < 350);
  CHECK(firstFrequency(tree) > 0.4);
  CHECK(firstFrequency(tree) < 0.9);
  SampleTreeSettings bare = settings;
  bare.leaves = false;
  CHECK(firstFrequency(sampleTree(bare)) > firstFrequency(tree));
}

TEST_CASE("V9: broadleaves of 5 to 20 m sway as fast as the method's table says") {
  const auto frequency = [](float height, float diameter, float modulus, bool leaves) {
    SampleTreeSettings settings;
    settings.height = height;
    settings.baseRadius = diameter / 2;
    settings.youngsModulus = modulus;
    settings.leaves = leaves;
    settings.sitesPerLink = 0;
    return firstFrequency(sampleTree(settings));
  };
  const struct {
    float height;
    double slow, fast;  ///< Hz, of base diameters from height / 60 to height / 40
  } rows[] = {{5, 0.91, 1.02}, {10, 0.53, 0.69}, {15, 0.38, 0.51}, {20, 0.30, 0.40}};
  for (const auto& row : rows) {
    CAPTURE(row.height);
    const double f = frequency(row.height, row.height / 50, 6e9f, true);
    MESSAGE(row.height, " m: ", f, " Hz (", row.slow, " to ", row.fast, ")");
    CHECK(f > 0.9 * row.slow);
    CHECK(f < 1.1 * row.fast);
  }
  const double stiff = frequency(10, 0.2f, 8e9f, true), usual = frequency(10, 0.2f, 6e9f, true),
               soft = frequency(10, 0.2f, 4e9f, true), bare = frequency(10, 0.2f, 6e9f, false);
  MESSAGE("10 m, 0.2 m thick: ", soft, ", ", usual, ", ", stiff, " Hz with 4, 6, 8 GPa; without leaves ", bare);
  CHECK(usual == doctest::Approx(0.61).epsilon(0.1));
  CHECK(soft == doctest::Approx(0.50).epsilon(0.1));
  CHECK(stiff == doctest::Approx(0.70).epsilon(0.1));
  CHECK(bare == doctest::Approx(0.69).epsilon(0.15));
  CHECK(bare > usual);
}

TEST_CASE("mass is wood by volume and leaves by area") {
  Link link;
  link.length = 2;
  link.radius = 0.1f;
  link.leafArea = 0.5f;
  CHECK(massOf(link).wood == doctest::Approx(950 * std::numbers::pi * 0.01 * 2).epsilon(1e-6));
  CHECK(massOf(link).leaves == doctest::Approx(0.09).epsilon(1e-6));
  CHECK(firstFrequency(Tree{}) == 0);
  CHECK(totalMass(Tree{}) == 0);
}

TEST_CASE("what can't be simulated is named with its link") {
  const Tree good = sampleTree();
  CHECK(problemOf(good).empty());
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const auto problem = [&](auto change) {
    Tree tree = good;
    tree.name = "birch";
    change(tree);
    return problemOf(tree);
  };
  CHECK(problem([](Tree& t) { t.links[7].length = 0; }) == "link 7 of birch: it has no length");
  CHECK(problem([](Tree& t) { t.links[8].radius = 0; }) == "link 8 of birch: it has no thickness");
  CHECK(problem([&](Tree& t) { t.links[9].length = nan; }) == "link 9 of birch: it has no length");
  CHECK(problem([&](Tree& t) { t.links[9].joint.y = nan; }) ==
        "link 9 of birch: its position is not a number or too far away");
  CHECK(problem([](Tree& t) { t.links[4].length = 1e30f; }) == "link 4 of birch: its length is beyond all measure");
  CHECK(problem([](Tree& t) { t.links[3].rotation = quat(0, 0, 0, 0); }) ==
        "link 3 of birch: its rotation is not a unit quaternion");
  CHECK(problem([](Tree& t) { t.links[5].parent = 5; }) == "link 5 of birch: its parent does not come before it");
  CHECK(problem([](Tree& t) { t.links[1].parent = -7; }) == "link 1 of birch: its parent does not come before it");
  CHECK(problem([](Tree& t) { t.links[2].stiffnessScale = -1; }) ==
        "link 2 of birch: its stiffness is negative or not a number");
  CHECK(problem([](Tree& t) { t.sites[0].link = 99999; }) == "leaf 0 of birch: it hangs on no link");
  CHECK(problem([](Tree& t) { t.links.back().parent = 0, t.links[t.links.size() - 2].parent = -1; }) ==
        "link 1905 of birch: the links of a subtree do not follow each other");
}

TEST_CASE("composites add up to the whole tree") {
  const Tree tree = sampleTree();
  const std::vector<LinkBody> bodies = bodiesOf(tree);
  const std::vector<Composite> composites = compositesOf(bodies);
  double mass = 0;
  glm::dvec3 moment(0);
  double trace = 0;
  for (const LinkBody& body : bodies) {
    mass += body.mass;
    const glm::dvec3 r = body.joint + body.arm() - bodies[0].joint;
    moment += body.mass * r;
    trace += 2 * body.across + body.along + 2 * body.mass * glm::dot(r, r);
  }
  CHECK(composites[0].mass == doctest::Approx(mass));
  CHECK(glm::length(composites[0].moment - moment) < 1e-9 * mass);
  const glm::dmat3& inertia = composites[0].inertia;
  CHECK(inertia[0][0] + inertia[1][1] + inertia[2][2] == doctest::Approx(trace).epsilon(1e-9));
}
