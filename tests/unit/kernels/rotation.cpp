#include "kernels/rotation.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "kernels/link_algebra.h"
#include "kernels/link_state.h"
#include "kernels/random.h"

using namespace windfall;

TEST_CASE("the exponential of a rotation vector is its unit quaternion") {
  RandomSequence random(1);
  for (int i = 0; i < 1000; ++i) {
    const glm::dvec3 axis = glm::normalize(glm::dvec3(random.normal(), random.normal(), random.normal()));
    const double angle = random.uniform(0, 1.5);
    const vec3 v(axis * angle);
    const Turn<float> e = exponentialOf(V3<float>{v.x, v.y, v.z});
    const vec4 q(e.x, e.y, e.z, e.w);
    CHECK(static_cast<double>(q.w) == doctest::Approx(std::cos(angle / 2)).epsilon(2e-7));
    CHECK(static_cast<double>(glm::length(vec3(q))) == doctest::Approx(std::sin(angle / 2)).epsilon(1e-6));
  }
  CHECK(exponentialOf(V3<float>{0, 0, 0}).w == 1);
}

TEST_CASE("an angle is clamped for display, and not a number becomes the rest pose") {
  CHECK(shownPart(V3<float>{0.5f, -1, 0.2f}) == 1);
  CHECK(50 * shownPart(V3<float>{30, -40, 0}) == doctest::Approx(1.5));
  CHECK(shownPart(V3<float>{std::numeric_limits<float>::quiet_NaN(), 0, 0}) == 0);
}

TEST_CASE("composition and inverse agree with GLM") {
  RandomSequence random(2);
  for (int i = 0; i < 100; ++i) {
    const auto draw = [&] {
      const auto n = [&] { return static_cast<float>(random.normal()); };
      return glm::normalize(quat(n(), n(), n(), n()));
    };
    const quat a = draw(), b = draw();
    const vec4 va(a.x, a.y, a.z, a.w), vb(b.x, b.y, b.z, b.w);
    const quat ab = a * b;
    CHECK(glm::length(compose(va, vb) - vec4(ab.x, ab.y, ab.z, ab.w)) < 1e-6f);
    const vec3 v(1, -2, 3);
    CHECK(glm::length(rotate(va, v) - a * v) < 1e-5f);
    CHECK(glm::length(rotateBack(va, rotate(va, v)) - v) < 1e-5f);
    CHECK(glm::length(compose(va, inverse(va)) - vec4(0, 0, 0, 1)) < 1e-6f);
    CHECK(glm::length(renormalise(va * 1.001f)) == doctest::Approx(1).epsilon(3e-6));
  }
}
