// V11 of tree_dynamics.md, 11: the loops in single precision beside the same arithmetic in double precision.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "sim/sample_tree.h"
#include "sim/wind.h"
#include "support/exact_tree.h"

using namespace windfall;
using namespace windfall::sim;
using windfall::test::ExactTree;

TEST_CASE("V11: single precision loses some micrometres in two seconds of wind on 10,000 links") {
  SampleTreeSettings sample = tenThousandLinks();
  sample.sitesPerLink = 0;
  const auto tree = std::make_shared<Tree>(sampleTree(sample));
  for (const TreeMethod method : {TreeMethod::Coupled, TreeMethod::Analytic, TreeMethod::Literal, TreeMethod::Forces}) {
    CAPTURE(std::string(nameOf(method)));
    FactorSettings settings;
    settings.method = method;
    settings.windSpeed = 8;
    settings.frequency = 0.6;
    TreeField field({{tree, {}}}, settings, 1);
    ExactTree exact(*tree, settings);
    WindField wind(vec3(-8, 0, -8), vec3(8, 12, 8), WindSettings{.speed = 8}, 1);
    for (int i = 0; i < 120; ++i) {
      wind.advance((i + 0.5) / 60);
      const WindView view = wind.view();
      field.step(view);
      exact.step([&](const glm::dvec3& place) { return glm::dvec3(windAt(view, vec3(place))); });
    }
    double square = 0, moved = 0;
    for (std::size_t i = 0; i < field.size(); ++i) {
      const glm::dvec3 off = glm::dvec3(field.current()[i].position) - exact.place(i);
      const glm::dvec3 way = exact.place(i) - exact.bodies()[i].joint;
      square += glm::dot(off, off) / static_cast<double>(field.size());
      moved += glm::dot(way, way) / static_cast<double>(field.size());
    }
    MESSAGE(std::string(nameOf(method)), ": rms difference ", std::sqrt(square), " m of a motion of ", std::sqrt(moved),
            " m");
    CHECK(std::sqrt(moved) > 1e-3);
    CHECK(std::sqrt(square) < 5e-6);
  }
}
