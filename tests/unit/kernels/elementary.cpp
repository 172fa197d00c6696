#include "kernels/elementary.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kernels/quaternion.h"
#include "kernels/random.h"

using namespace windfall;

TEST_CASE("sine and cosine of turns err by less than 1.5e-7 beside the argument's own rounding") {
  double worst = 0;
  for (int k = -400000; k <= 400000; ++k) {
    const float turns = static_cast<float>(k) * 1.3e-5f;
    const SinCos got = sinCosTurns(turns);
    const double angle = 2 * std::numbers::pi * static_cast<double>(turns);
    worst = std::max({worst, std::abs(static_cast<double>(got.sin) - std::sin(angle)),
                      std::abs(static_cast<double>(got.cos) - std::cos(angle))});
  }
  CHECK(worst < 1.5e-7);
  CHECK(sinCosTurns(0.0f).sin == 0.0f);
  CHECK(sinCosTurns(0.25f).sin == 1.0f);
  CHECK(sinCosTurns(-0.5f).cos == -1.0f);
}

TEST_CASE("the exponential errs by less than 3e-7 of its value, and stays finite") {
  double worst = 0;
  for (int k = -86000; k <= 86000; ++k) {
    const float x = static_cast<float>(k) * 1e-3f;
    const double right = std::exp(static_cast<double>(x));
    worst = std::max(worst, std::abs(static_cast<double>(expOf(x)) - right) / right);
  }
  CHECK(worst < 3e-7);
  CHECK(expOf(-1e30f) < 1e-37f);
  CHECK(std::isfinite(expOf(1e30f)));
  for (float x = 0; x < 20; x += 0.01f) CHECK(std::abs(tanhOf(x) - std::tanh(x)) < 3e-7f);
}

TEST_CASE("a rotation in 32 bits is off by a quarter of a degree at most, and of unit length") {
  double worst = 0, sum = 0, length = 0;
  constexpr int kCount = 200000;
  for (std::uint32_t k = 0; k < kCount; ++k) {
    const auto draw = [k](std::uint32_t n) { return uniform(7, k, n) - 0.5f; };
    const vec4 q = normalized({draw(0), draw(1), draw(2), draw(3)});
    const vec4 back = unpacked(packed(q));
    const double dot = std::abs(static_cast<double>(q.x * back.x + q.y * back.y + q.z * back.z + q.w * back.w));
    const double degrees = 2 * std::acos(std::min(1.0, dot)) * 180 / std::numbers::pi;
    worst = std::max(worst, degrees);
    sum += degrees;
    length = std::max(length, std::abs(1.0 - std::sqrt(static_cast<double>(glm::dot(back, back)))));
  }
  CHECK(worst < 0.25);
  CHECK(sum / kCount < 0.1);
  CHECK(length < 1e-3);
}
