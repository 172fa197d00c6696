// Shelter, stands and fans.
#include <doctest/doctest.h>

#include <cmath>

#include "sim/sample_tree.h"
#include "sim/wind.h"

using namespace windfall;
using namespace windfall::sim;

namespace {

const vec3 kLower(-20, 0, -20), kUpper(20, 14, 20);

WindSettings steady(float speed) {
  WindSettings settings;
  settings.speed = speed;
  settings.turbulence = 0;
  settings.gustStrength = 0;
  return settings;
}

/// A crown of 4 m across around (0, 7, 0), leaf area density 1.
std::vector<Foliage> crown() {
  std::vector<Foliage> foliage;
  for (int z = -2; z < 2; ++z) {
    for (int y = 5; y < 9; ++y) {
      for (int x = -2; x < 2; ++x) foliage.push_back({vec3(x, y, z) + vec3(0.5f), 1});
    }
  }
  return foliage;
}

float speedAt(const WindField& wind, vec3 place) { return glm::length(windAt(wind.view(), place)); }

}  // namespace

TEST_CASE("leaves shelter what stands behind them, whichever way it blows") {
  for (const vec3 direction : {vec3(1, 0, 0), vec3(0, 0, -1), vec3(-0.7071f, 0, 0.7071f)}) {
    WindSettings settings = steady(8);
    settings.direction = direction;
    WindField open(kLower, kUpper, settings, 1), sheltered(kLower, kUpper, settings, 1);
    sheltered.setFoliage(crown());
    open.advance(0);
    sheltered.advance(0);
    const vec3 middle(0, 7, 0), behind = middle + 5.f * direction, before = middle - 6.f * direction;
    // Beer and Lambert: exp(-0.5 * 0.15 * 4 m) = 0.74 behind the whole crown, half of it in its middle.
    CHECK(speedAt(sheltered, behind) / speedAt(open, behind) == doctest::Approx(0.77).epsilon(0.06));
    CHECK(speedAt(sheltered, middle) / speedAt(open, middle) == doctest::Approx(0.87).epsilon(0.06));
    CHECK(speedAt(sheltered, before) / speedAt(open, before) > 0.97f);
    CHECK(speedAt(sheltered, vec3(0, 12, 0)) == doctest::Approx(speedAt(open, vec3(0, 12, 0))));
  }
}

TEST_CASE("a wake fades downwind, two crowns shelter more than one, and shelter can be turned off") {
  WindSettings settings = steady(8);
  WindField one(kLower, kUpper, settings, 1), two(kLower, kUpper, settings, 1);
  std::vector<Foliage> pair = crown();
  for (Foliage leaf : crown()) {
    leaf.place.x -= 8;
    pair.push_back(leaf);
  }
  one.setFoliage(crown());
  two.setFoliage(pair);
  one.advance(0);
  two.advance(0);
  CHECK(speedAt(one, vec3(19, 7, 0)) > speedAt(one, vec3(4, 7, 0)) * 1.05f);
  CHECK(speedAt(two, vec3(4, 7, 0)) < speedAt(one, vec3(4, 7, 0)) * 0.9f);
  settings.shelter = 0;
  two.set(settings, 0);
  two.advance(0);
  CHECK(speedAt(two, vec3(4, 7, 0)) == doctest::Approx(8 * std::log(7 / 0.03) / std::log(10 / 0.03)).epsilon(0.02));
}

TEST_CASE("inside a stand the wind is slow and above it it grows with the logarithm") {
  CHECK(windProfile(10, 20) == doctest::Approx(1));
  CHECK(windProfile(20, 20) / windProfile(10, 20) == doctest::Approx(std::exp(2.5 * 0.5)).epsilon(1e-4));
  CHECK(windProfile(30, 20) / windProfile(20, 20) ==
        doctest::Approx(std::log(16.0 / 2) / std::log(6.0 / 2)).epsilon(1e-4));
  CHECK(windProfile(2, 20) < windProfile(10, 20) * 0.5f);
  CHECK(windProfile(0, 20) == 0);
}

TEST_CASE("a fan blows where it points, slower with the distance, and not behind itself") {
  WindSettings settings = steady(0);
  Fan fan;
  fan.position = vec3(-5, 6, 0);
  fan.direction = vec3(2, 0, 0);
  fan.strength = 12;
  settings.fans = {fan};
  WindField wind(kLower, kUpper, settings, 1);
  const auto mean = [&](vec3 place) {
    vec3 sum(0);
    for (int i = 0; i < 400; ++i) {
      wind.advance(i / 60.0);
      sum += windAt(wind.view(), place);
    }
    return sum / 400.f;
  };
  CHECK(mean(vec3(-4.9f, 6, 0)).x == doctest::Approx(12).epsilon(0.12));
  const float near = mean(vec3(-3, 6, 0)).x, far = mean(vec3(3, 6, 0)).x;
  // Speed times radius is constant: (0.6 + 0.194 * 8) / (0.6 + 0.194 * 2) = 2.2.
  CHECK(near / far == doctest::Approx(2.18).epsilon(0.15));
  CHECK(glm::length(mean(vec3(-6, 6, 0))) == 0.f);
  CHECK(glm::length(mean(vec3(-3, 9, 0))) < 0.01f);
  settings.fans.front().on = false;
  wind.set(settings, 0);
  CHECK(glm::length(mean(vec3(-3, 6, 0))) == 0.f);
}

TEST_CASE("nonsense of fans and no more than eight of them blow") {
  WindSettings settings = steady(0);
  Fan fan;
  fan.position.x = std::nanf("");
  settings.fans.assign(20, fan);
  WindField wind(kLower, kUpper, settings, 1);
  CHECK(wind.view().fanCount == 0);
  settings.fans.assign(20, Fan{});
  wind.set(settings, 0);
  CHECK(wind.view().fanCount == kMostFans);
}
