#include "sim/wind.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

using namespace windfall;
using namespace windfall::sim;

namespace {

const vec3 kLower(-8, 0, -8), kUpper(8, 12, 8);

WindSettings steady(float speed) {
  WindSettings settings;
  settings.speed = speed;
  settings.turbulence = 0;
  settings.gustStrength = 0;
  return settings;
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

double deviation(const std::vector<double>& values) {
  const double m = mean(values);
  double sum = 0;
  for (const double v : values) sum += (v - m) * (v - m);
  return std::sqrt(sum / static_cast<double>(values.size()));
}

}  // namespace

TEST_CASE("the mean follows the logarithm of height and is the setting at 10 m") {
  WindSettings settings = steady(6);
  settings.direction = vec3(0, 0.7f, -2);
  const WindField wind(kLower, kUpper, settings, 1);
  CHECK(glm::length(wind.velocity(vec3(3, 10, 2), 5) - vec3(0, 0, -6)) < 1e-5f);
  CHECK(wind.velocity(vec3(3, 2, 2), 5).z ==
        doctest::Approx(-6 * std::log(2 / 0.03) / std::log(10 / 0.03)).epsilon(1e-5));
  CHECK(wind.velocity(vec3(0, 0, 0), 5) == vec3(0));
  CHECK(wind.velocity(vec3(0, -3, 0), 5) == vec3(0));
}

TEST_CASE("turbulence has the deviation that was asked for, less across and least upward") {
  std::vector<double> along, across, up;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    WindSettings settings;
    settings.speed = 7;
    settings.turbulence = 0.2f;
    settings.gustStrength = 0;
    settings.seed = seed;
    const WindField wind(kLower, kUpper, settings, 1);
    for (int i = 0; i < 60; ++i) {
      const vec3 v = wind.velocity(vec3(0, 10, 0), 7.0 * i);
      along.push_back(static_cast<double>(v.x));
      up.push_back(static_cast<double>(v.y));
      across.push_back(static_cast<double>(v.z));
    }
  }
  CHECK(mean(along) == doctest::Approx(7).epsilon(0.02));
  CHECK(deviation(along) == doctest::Approx(1.4).epsilon(0.08));
  CHECK(deviation(across) == doctest::Approx(0.8 * 1.4).epsilon(0.08));
  CHECK(deviation(up) == doctest::Approx(0.5 * 1.4 * 10 / 11).epsilon(0.08));
}

TEST_CASE("eddies travel with the mean wind (Taylor)") {
  double best = -1, bestLag = 0;
  for (double lag = 0.3; lag <= 1.4; lag += 0.05) {
    double product = 0, first = 0, second = 0;
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
      WindSettings settings;
      settings.speed = 6;
      settings.gustStrength = 0;
      settings.seed = seed;
      const WindField wind(kLower, kUpper, settings, 1);
      for (int i = 0; i < 40; ++i) {
        const double t = 3.0 * i;
        const double a = static_cast<double>(wind.velocity(vec3(0, 10, 0), t).x) - 6;
        const double b = static_cast<double>(wind.velocity(vec3(5, 10, 0), t + lag).x) - 6;
        product += a * b;
        first += a * a;
        second += b * b;
      }
    }
    const double correlation = product / std::sqrt(first * second);
    if (correlation > best) {
      best = correlation;
      bestLag = lag;
    }
  }
  CHECK(best > 0.8);
  CHECK(bestLag == doctest::Approx(5.0 / 6).epsilon(0.1));
}

TEST_CASE("fronts come at their period, travel downwind and leave the mean as it is") {
  WindSettings settings = steady(10);
  settings.gustStrength = 1;
  settings.gustPeriod = 8;
  const WindField wind(kLower, kUpper, settings, 1);
  std::vector<double> speed;
  int rises = 0;
  for (int i = 0; i < 8000; ++i) {
    speed.push_back(static_cast<double>(wind.velocity(vec3(0, 10, 0), 0.1 * i).x));
    if (i > 0 && speed[speed.size() - 2] < 11 && speed.back() >= 11) ++rises;
  }
  CHECK(mean(speed) == doctest::Approx(10).epsilon(0.03));
  CHECK(rises == doctest::Approx(100).epsilon(0.011));
  CHECK(*std::max_element(speed.begin(), speed.end()) > 16);
  CHECK(*std::max_element(speed.begin(), speed.end()) < 25);
  // 20 m downwind the same front is 2 s later.
  for (double t = 0; t < 16; t += 0.37) {
    const float here = wind.velocity(vec3(0, 10, 0), t).x, there = wind.velocity(vec3(20, 10, 0), t + 2).x;
    CHECK(here == doctest::Approx(there).epsilon(1e-3));
  }
}

TEST_CASE("the lattice depends on the time alone, not on the steps that led there") {
  WindSettings settings;
  settings.speed = 9;
  WindField stepped(kLower, kUpper, settings, 2), jumped(kLower, kUpper, settings, 1);
  double time = 0;
  for (int i = 0; i < 100; ++i) stepped.advance(time += 1.0 / 60);
  jumped.advance(time);
  const WindView a = stepped.view(), b = jumped.view();
  const auto nodes = static_cast<std::ptrdiff_t>(a.nx) * a.ny * a.nz;
  CHECK(nodes > 500);
  CHECK(std::equal(a.velocity, a.velocity + nodes, b.velocity));
}

TEST_CASE("the lattice has the bits of the field's formula on any instruction set") {
  WindSettings settings;
  settings.speed = 9;
  WindField wind(kLower, kUpper, settings, 2);
  wind.advance(0.25);
  const WindView view = wind.view();
  const vec3 cell = (kUpper - kLower) / vec3(view.nx - 1, view.ny - 1, view.nz - 1);
  for (int z = 0; z < view.nz; ++z) {
    const int x = z % view.nx, y = z % view.ny;
    const vec3 place = kLower + vec3(x, y, z) * cell;
    const vec4 node = view.velocity[(z * view.ny + y) * view.nx + x];
    CHECK(node == windNode(wind.moment(0.25), place, windProfile(place.y)));
  }
}

TEST_CASE("the lattice follows the field") {
  WindSettings settings;
  settings.speed = 8;
  WindField wind(kLower, kUpper, settings, 1);
  double error = 0, size = 0;
  for (int i = 0; i < 60; ++i) {
    const double time = 0.31 * i;
    wind.advance(time);
    const vec3 place(0.13f * static_cast<float>(i) - 4, 2 + 0.15f * static_cast<float>(i), 1.7f);
    const vec3 exact = wind.velocity(place, time), sampled = windAt(wind.view(), place);
    error += static_cast<double>(glm::dot(exact - sampled, exact - sampled));
    size += static_cast<double>(glm::dot(exact, exact));
  }
  CHECK(std::sqrt(error / size) < 0.08);
}

TEST_CASE("a change of speed goes on from the same eddies, and the wind ends when it is told to") {
  WindSettings settings;
  settings.speed = 8;
  settings.gustStrength = 0;
  settings.until = 30;
  WindField wind(kLower, kUpper, settings, 1);
  const vec3 before = wind.velocity(vec3(0, 10, 0), 20);
  settings.speed = 8.001f;
  wind.set(settings, 20);
  CHECK(glm::length(wind.velocity(vec3(0, 10, 0), 20) - before) < 0.01f);
  CHECK(wind.velocity(vec3(0, 10, 0), 29).x > 2);
  CHECK(wind.velocity(vec3(0, 10, 0), 31.1) == vec3(0));
  CHECK(wind.level(29) == 8.001f);
  CHECK(wind.level(31) == 0);
}

TEST_CASE("nonsense in the settings blows nothing up") {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  WindSettings settings;
  settings.speed = nan;
  settings.direction = vec3(nan, 0, 0);
  settings.turbulence = nan;
  settings.gustStrength = nan;
  settings.gustPeriod = nan;
  CHECK(WindField(kLower, kUpper, settings, 1).velocity(vec3(1, 10, 1), 3) == vec3(0));
}
