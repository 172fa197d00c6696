#include "sim/tree_field.h"

#include <doctest/doctest.h>

#include <cmath>

#include "kernels/link_pose.h"
#include "kernels/random.h"
#include "sim/sample_tree.h"
#include "support/uniform_wind.h"

using namespace windfall;
using namespace windfall::sim;
using windfall::test::UniformWind;

namespace {

TreeField fieldOf(Tree tree, const FactorSettings& settings, int threads = 1, const FieldCut& cut = {}) {
  return TreeField({{std::make_shared<Tree>(std::move(tree)), {}}}, settings, threads, cut);
}

void setAngles(TreeField& field, float size) {
  RandomSequence random(5);
  for (std::size_t i = 0; i < field.size(); ++i) {
    const auto draw = [&] { return size * static_cast<float>(random.uniform(-1, 1)); };
    const float x = draw(), y = draw(), z = draw();
    field.setJoint(i, vec3(x, y, z));
  }
  field.pose();
}

SampleTreeSettings smallTree() {
  SampleTreeSettings settings;
  settings.children = {6, 5, 3};
  return settings;
}

vec3 dragOn(const LinkShape& shape, const vec3& along, const vec3& u) {
  const V3<float> f = dragOf<float>(shape.woodDrag, shape.leafDrag, {along.x, along.y, along.z}, {u.x, u.y, u.z});
  return {f.x, f.y, f.z};
}

vec3 tipOf(const TreeField& field, std::size_t link) {
  return placeOf(field.current()[link], vec3(0, 0, 2 * field.shape(link).halfLength));
}

}  // namespace

TEST_CASE("without damping energy never grows, over ten decades of stiffness and any step") {
  const UniformWind calm(vec3(0));
  for (const float stiffness : {1e-5f, 1e-2f, 1.f, 1e2f, 1e5f}) {
    for (const double h : {1.0 / 240, 1.0 / 60, 1.0 / 10, 1.0, 10.0}) {
      for (const double implicitness : {0.5, 0.6}) {
        CAPTURE(stiffness);
        CAPTURE(h);
        CAPTURE(implicitness);
        Tree tree = sampleTree(smallTree());
        for (Link& link : tree.links) {
          link.stiffnessScale = stiffness;
          link.windScale = 0;
        }
        FactorSettings settings;
        settings.h = h;
        settings.implicitness = implicitness;
        settings.dampingRatio = 0;
        settings.gravity = glm::dvec3(0);
        TreeField field = fieldOf(tree, settings);
        setAngles(field, 0.1f);
        const double start = field.elasticEnergy();
        double last = start;
        bool grew = false;
        for (int i = 0; i < 60; ++i) {
          field.step(calm.view());
          const double energy = field.elasticEnergy() + field.kineticEnergy();
          // Single precision rounds; what is left at the end is noise.
          const double slack = implicitness > 0.55 ? (last > 1e-4 * start ? 0 : 1e-6 * start) : 5e-5 * start;
          grew = grew || !(energy <= last + slack);
          last = energy;
        }
        CHECK_FALSE(grew);
      }
    }
  }
}

TEST_CASE("in steady wind the tree leans until springs carry the loads, whatever the step") {
  const UniformWind wind(vec3(8, 0, 0));
  const Tree tree = sampleTree(smallTree());
  vec3 first(0);
  for (const double h : {1.0 / 240, 1.0 / 60, 1.0 / 30}) {
    CAPTURE(h);
    FactorSettings settings;
    settings.h = h;
    settings.windSpeed = 8;
    TreeField field = fieldOf(tree, settings);
    for (int i = 0; i < static_cast<int>(60 / h); ++i) field.step(wind.view());

    // The torques of the current pose, summed here in double precision.
    const std::size_t n = field.size();
    std::vector<glm::dvec3> force(n), torque(n);
    double difference = 0, total = 0;
    for (std::size_t i = n; i-- > 0;) {
      const LinkState& state = field.current()[i];
      const LinkShape shape = field.shape(i);
      const vec3 along = rotate(state.rotation, vec3(0, 0, 1));
      const glm::dvec3 own(dragOn(shape, along, vec3(8, 0, 0)) - vec3(0, shape.weight, 0));
      force[i] += own;
      torque[i] += glm::cross(glm::dvec3(along * shape.halfLength), own);
      if (shape.parent >= 0) {
        const auto p = static_cast<std::size_t>(shape.parent);
        force[p] += force[i];
        torque[p] += torque[i] + glm::cross(glm::dvec3(state.position - field.current()[p].position), force[i]);
      }
      const vec4 parent =
          shape.parent < 0 ? vec4(0, 0, 0, 1) : field.current()[static_cast<std::size_t>(shape.parent)].rotation;
      vec3 local = rotateBack(shape.restRotation, rotateBack(parent, vec3(torque[i]))) - shape.preStress;
      const float q = glm::length(local / shape.stiffness) / 0.8f;
      local *= std::pow(1 + q * q * q * q, -0.25f);
      const vec3 rest = shape.stiffness * field.angle(i) - local;
      difference += static_cast<double>(glm::dot(rest, rest));
      total += static_cast<double>(glm::dot(local, local));
    }
    CHECK(std::sqrt(difference / total) < 2e-5);
    CHECK(field.kineticEnergy() < 1e-6 * field.elasticEnergy());
    const vec3 tip = tipOf(field, 9);
    if (first == vec3(0)) first = tip;
    CHECK(glm::length(tip - first) < 2e-4f);
  }
  CHECK(first.x > 0.02f);
  CHECK(first.x < 2);
}

TEST_CASE("the number of threads does not change a bit") {
  const UniformWind wind(vec3(9, 0, 3));
  FactorSettings settings;
  settings.windSpeed = 9;
  TreeField one = fieldOf(sampleTree(), settings, 1), two = fieldOf(sampleTree(), settings, 2);
  for (int i = 0; i < 60; ++i) {
    one.step(wind.view());
    two.step(wind.view());
  }
  const auto same = [&](const TreeField& other) {
    return std::equal(one.current().begin(), one.current().end(), other.current().begin(),
                      [](const LinkState& a, const LinkState& b) {
                        return a.rotation == b.rotation && a.position == b.position && a.velocity == b.velocity;
                      });
  };
  CHECK(one.largestAngle() > 0.02f);
  CHECK(same(two));
}

TEST_CASE("in calm air the rest pose stays, leaning branches included") {
  const UniformWind calm(vec3(0));
  TreeField field = fieldOf(sampleTree(), {});
  for (int i = 0; i < 300; ++i) field.step(calm.view());
  CHECK(field.largestAngle() < 1e-4f);
}

TEST_CASE("velocities of links are the rate of their places") {
  const UniformWind wind(vec3(10, 0, 0));
  FactorSettings settings;
  settings.h = 1.0 / 2000;
  settings.windSpeed = 10;
  TreeField field = fieldOf(sampleTree(smallTree()), settings);
  for (int i = 0; i < 800; ++i) field.step(wind.view());
  double difference = 0, size = 0;
  for (std::size_t i = 0; i < field.size(); ++i) {
    const LinkState &a = field.previous()[i], &b = field.current()[i];
    const vec3 rate = (b.position - a.position) * 2000.f;
    const vec3 mean = 0.5f * (a.velocity + b.velocity);
    difference += static_cast<double>(glm::dot(rate - mean, rate - mean));
    size += static_cast<double>(glm::dot(mean, mean));
  }
  CHECK(size > 0);
  CHECK(std::sqrt(difference / size) < 0.05);
}

TEST_CASE("fallen leaves make a tree lighter and let more wind through") {
  Tree tree = sampleTree(smallTree());
  std::vector<float> lost;
  for (const Link& link : tree.links) lost.push_back(link.leafArea);
  TreeField field = fieldOf(tree, {});
  const float drag = field.shape(5).leafDrag, weight = field.shape(0).weight;
  double before = 0, after = 0;
  for (std::size_t i = 0; i < field.size(); ++i) before += static_cast<double>(field.shape(i).weight);
  field.setLostArea(lost);
  for (std::size_t i = 0; i < field.size(); ++i) {
    const LinkShape shape = field.shape(i);
    after += static_cast<double>(shape.weight);
    CHECK(shape.leafDrag == 0);
  }
  CHECK(drag >= 0);
  CHECK(field.shape(0).weight == weight);  // the trunk's own
  CHECK(after < before);
}
