#include "kernels/noise.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace windfall;

namespace {
vec4 somewhere(RandomSequence& random) {
  const auto draw = [&] { return static_cast<float>(random.uniform(-500, 500)); };
  return {draw(), draw(), draw(), draw()};
}
}  // namespace

TEST_CASE("noise has mean 0, the stated deviation and independent components") {
  RandomSequence random(3);
  glm::dvec3 mean(0), square(0), cross(0);
  constexpr int kSamples = 200000;
  for (int i = 0; i < kSamples; ++i) {
    const glm::dvec3 v(noise4(static_cast<std::uint32_t>(i / 1000), somewhere(random)));
    mean += v;
    square += v * v;
    cross += glm::dvec3(v.x * v.y, v.y * v.z, v.z * v.x);
  }
  for (int k = 0; k < 3; ++k) {
    CHECK(std::abs(mean[k] / kSamples) < 0.005);
    CHECK(std::sqrt(square[k] / kSamples) == doctest::Approx(static_cast<double>(kNoiseRms)).epsilon(0.015));
    CHECK(std::abs(cross[k] / square[k]) < 0.02);
  }
}

TEST_CASE("noise is continuous across cells and differs between seeds") {
  RandomSequence random(4);
  for (int i = 0; i < 200; ++i) {
    vec4 p = somewhere(random);
    p[i % 4] = std::floor(p[i % 4]);
    vec4 before = p, after = p;
    before[i % 4] -= 1e-4f;
    after[i % 4] += 1e-4f;
    CHECK(glm::length(noise4(7, before) - noise4(7, after)) < 2e-3f);
    CHECK(noise4(7, p) == noise4(7, p));
    CHECK(noise4(7, p + 0.5f) != noise4(8, p + 0.5f));
  }
  CHECK(noise4(1, vec4(3, -2, 5, 0)) == vec3(0));
}
