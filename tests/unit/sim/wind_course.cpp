#include "sim/wind_course.h"

#include <doctest/doctest.h>

#include <cmath>

#include "sim/wind.h"

using namespace windfall;
using namespace windfall::sim;

namespace {

WindSettings curved() {
  WindSettings settings;
  settings.speed = 10;
  settings.direction = vec3(0, 0, -1);
  settings.course = WindCourse::Curve;
  settings.repeat = false;
  settings.curve = {{0, 0.2f, 0}, {10, 1, 0}, {20, 1, 90}, {30, 0, 90}};
  return settings;
}

}  // namespace

TEST_CASE("a curve passes through its keys, is smooth, and never overshoots") {
  const auto keys = curved().curve;
  for (const WindKey& key : keys) {
    CHECK(curveAt(keys, key.time).strength == doctest::Approx(key.strength));
    CHECK(curveAt(keys, key.time).turn == doctest::Approx(key.turn));
  }
  float last = curveAt(keys, 0).strength, lastStep = 0;
  for (float t = 0; t <= 30; t += 0.05f) {
    const float now = curveAt(keys, t).strength;
    CHECK(now >= 0);
    CHECK(now <= 1.0001f);
    CHECK(std::abs((now - last) - lastStep) < 0.003f);
    lastStep = now - last;
    last = now;
  }
  CHECK(curveAt(keys, -5).strength == 0.2f);
  CHECK(curveAt(keys, 99).strength == 0.f);
  CHECK(curveAt({}, 3).strength == 1.f);
}

TEST_CASE("the way of the air is the integral of its velocity") {
  const WindTimeline timeline(curved());
  glm::dvec3 way(0);
  double length = 0;
  constexpr double kStep = 1e-3;
  for (int i = 0; i < 25000; ++i) {
    const double time = (i + 0.5) * kStep;
    way += static_cast<double>(timeline.speed(time)) * glm::dvec3(timeline.direction(time)) * kStep;
    length += static_cast<double>(timeline.speed(time)) * kStep;
  }
  CHECK(glm::length(timeline.travel(25) - way) < 0.05);
  CHECK(timeline.distance(25) == doctest::Approx(length).epsilon(1e-3));
  // Turned by 90 degrees clockwise from north it blows to the east.
  CHECK(timeline.direction(25).x == doctest::Approx(1));
}

TEST_CASE("a course that repeats goes on as it began, and its way never jumps") {
  WindSettings settings = curved();
  settings.repeat = true;
  const WindTimeline timeline(settings);
  CHECK(timeline.speed(3) == doctest::Approx(timeline.speed(33)));
  CHECK(timeline.distance(63) ==
        doctest::Approx(2 * timeline.distance(30 - 1e-9) + timeline.distance(3)).epsilon(1e-6));
  for (double time = 0.01; time < 70; time += 0.01) {
    CHECK(timeline.distance(time) - timeline.distance(time - 0.01) < 0.11);
    CHECK(timeline.distance(time) >= timeline.distance(time - 0.01) - 1e-9);
  }
}

TEST_CASE("records are interpolated, directions the short way round") {
  WindSettings settings;
  settings.course = WindCourse::Recorded;
  settings.repeat = false;
  settings.records = {{0, 2, 350}, {10, 6, 10}};
  const WindTimeline timeline(settings);
  CHECK(timeline.speed(5) == doctest::Approx(4));
  CHECK(timeline.direction(5).z == doctest::Approx(-1));
  CHECK(timeline.speed(1000) == doctest::Approx(6));
}

TEST_CASE("the field follows a record, and its level changes seldom") {
  WindSettings settings;
  settings.course = WindCourse::Recorded;
  settings.turbulence = 0;
  settings.gustStrength = 0;
  settings.records = {{0, 4, 90}, {60, 8, 90}, {61, 8, 90}};
  settings.repeat = false;
  WindField wind(vec3(-8, 0, -8), vec3(8, 12, 8), settings, 1);
  wind.advance(30);
  CHECK(windAt(wind.view(), vec3(0, 10, 0)).x == doctest::Approx(6).epsilon(0.01));
  int changes = 0;
  float level = wind.level(0);
  for (double time = 0; time < 61; time += 1.0 / 60) {
    CHECK(wind.level(time) >= wind.moment(std::floor(time)).speed * 0.999f);
    if (wind.level(time) != level) ++changes, level = wind.level(time);
  }
  CHECK(changes >= 2);
  CHECK(changes <= 5);
}

TEST_CASE("an unsound course counts as none") {
  WindSettings settings = curved();
  settings.curve[2].time = 5;
  CHECK(WindTimeline(settings).isSteady());
  settings.course = WindCourse::Recorded;
  CHECK(WindTimeline(settings).isSteady());
  CHECK(WindTimeline(settings).speed(7) == 10.f);
}
