// The physics that the closed motions imitate: a plate falling in two dimensions (Andersen, Pesavento & Wang 2005;
// falling_leaves.md, 2), whose regimes tell which features a believable leaf must have.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace {

using State = std::array<double, 6>;  // vx, vy (body), theta, omega, X, Y; lengths in half chords

State slope(const State& s, double inertia) {
  constexpr double kCt = 1.2, kCr = std::numbers::pi, kA = 1.4, kB = 1.0, kMu = 0.2, kBeta2 = 1.0 / 196;
  const auto [vx, vy, theta, omega, x, y] = s;
  const double v = std::sqrt(vx * vx + vy * vy) + 1e-12;
  const double circulation = 2 / std::numbers::pi * (-kCt * vx * vy / v + kCr * omega);
  const double drag = (kA - kB * (vx * vx - vy * vy) / (v * v)) * v / std::numbers::pi;
  const double added = inertia * (1 + kBeta2) + 0.5 * (1 - kBeta2) * (1 - kBeta2);
  return {((inertia + 1) * omega * vy - circulation * vy - std::sin(theta) - drag * vx) / (inertia + kBeta2),
          (-(inertia + kBeta2) * omega * vx + circulation * vx - std::cos(theta) - drag * vy) / (inertia + 1),
          omega,
          (-(1 - kBeta2) * vx * vy - (kMu + kMu * std::abs(omega)) * omega) / (0.25 * added),
          vx * std::cos(theta) - vy * std::sin(theta),
          vx * std::sin(theta) + vy * std::cos(theta)};
}

struct Fall {
  double descent, drift, range, frequency, spin;
  double tiltAndPlace;  ///< correlation
  double tiltAndSpeed;
};

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const auto n = static_cast<double>(a.size());
  double ma = 0, mb = 0, ab = 0, aa = 0, bb = 0;
  for (std::size_t i = 0; i < a.size(); ++i) ma += a[i] / n, mb += b[i] / n;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ab += (a[i] - ma) * (b[i] - mb), aa += (a[i] - ma) * (a[i] - ma), bb += (b[i] - mb) * (b[i] - mb);
  }
  return ab / std::sqrt(aa * bb);
}

/// Means over the last 60 % of 200 time units, from a tilt of 0.2 rad.
Fall drop(double inertia) {
  constexpr double kStep = 0.01;
  constexpr int kSteps = 20000, kFrom = 8000;
  State s{0, 0, 0.2, 0, 0, 0};
  State start{};
  double low = 1e9, high = -1e9;
  int crossings = 0;
  std::vector<double> tilt, place, speed;
  for (int k = 0; k < kSteps; ++k) {
    if (k == kFrom) start = s;
    const auto add = [](const State& a, const State& b, double h) {
      State r{};
      for (std::size_t i = 0; i < r.size(); ++i) r[i] = a[i] + h * b[i];
      return r;
    };
    const State k1 = slope(s, inertia), k2 = slope(add(s, k1, kStep / 2), inertia);
    const State k3 = slope(add(s, k2, kStep / 2), inertia), k4 = slope(add(s, k3, kStep), inertia);
    const double before = s[2];
    for (std::size_t i = 0; i < s.size(); ++i) s[i] += kStep / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
    if (k < kFrom) continue;
    low = std::min(low, s[2]), high = std::max(high, s[2]);
    if ((before < 0) != (s[2] < 0)) ++crossings;
    tilt.push_back(s[2]), place.push_back(s[4]), speed.push_back((s[4] - start[4]));
  }
  for (std::size_t i = 0; i + 1 < place.size(); ++i) speed[i] = (place[i + 1] - place[i]) / kStep;
  speed.back() = speed[speed.size() - 2];
  const double time = kStep * (kSteps - kFrom);
  return {(start[5] - s[5]) / time, std::abs(s[4] - start[4]) / time, (high - low) / 2,
          crossings / 2.0 / time,   std::abs(s[2] - start[2]) / time, correlation(tilt, place),
          correlation(tilt, speed)};
}

}  // namespace

TEST_CASE("a light plate flutters as published") {
  const struct {
    double inertia, descent, range, frequency;
  } table[] = {{0.2, 0.285, 0.85, 0.25}, {0.5, 0.298, 1.49, 0.158}, {1.0, 0.459, 2.79, 0.075}};
  for (const auto& row : table) {
    CAPTURE(row.inertia);
    const Fall fall = drop(row.inertia);
    CHECK(fall.descent == doctest::Approx(row.descent).epsilon(0.03));
    CHECK(2 * fall.range == doctest::Approx(row.range).epsilon(0.03));
    CHECK(fall.frequency == doctest::Approx(row.frequency).epsilon(0.06));
    CHECK(fall.drift < 0.01);
    // What the closed motions take over: tilt goes with place and not with speed.
    CHECK(fall.tiltAndPlace > 0.97);
    CHECK(std::abs(fall.tiltAndSpeed) <= 0.09);
  }
}

TEST_CASE("fluttering gives way to tumbling between inertias of 1.20 and 1.25") {
  const Fall before = drop(1.20), after = drop(1.25), well = drop(1.40);
  CHECK(before.range < 2);
  CHECK(after.range > 2 * std::numbers::pi);
  CHECK(after.descent == doctest::Approx(0.91).epsilon(0.03));
  CHECK(after.drift == doctest::Approx(0.95).epsilon(0.03));
  CHECK(well.descent == doctest::Approx(0.315).epsilon(0.03));
  CHECK(well.drift == doctest::Approx(0.75).epsilon(0.03));
  CHECK(well.spin == doctest::Approx(0.49).epsilon(0.03));
}

TEST_CASE("a heavy plate falls broadside at its terminal speed") {
  for (const double inertia : {3.0, 5.0}) {
    const Fall fall = drop(inertia);
    CHECK(fall.descent > 1.03);
    CHECK(fall.descent < 1.18);
    CHECK(fall.drift < 0.02);
  }
}
