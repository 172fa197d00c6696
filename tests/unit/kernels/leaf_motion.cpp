#include "kernels/leaf_motion.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "kernels/leaf_traits.h"

using namespace windfall;

namespace {

/// V_t = 1 m/s, chord 8 cm: the leaf of the method's table.
LeafTraits tableLeaf() { return {1.0f, kFlutterRate / 0.04f, 1.0f, 0.0f, 1.0f}; }

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  double ma = 0, mb = 0;
  for (std::size_t i = 0; i < a.size(); ++i) ma += a[i], mb += b[i];
  ma /= static_cast<double>(a.size()), mb /= static_cast<double>(b.size());
  double ab = 0, aa = 0, bb = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ab += (a[i] - ma) * (b[i] - mb), aa += (a[i] - ma) * (a[i] - ma), bb += (b[i] - mb) * (b[i] - mb);
  }
  return ab / std::sqrt(aa * bb);
}

/// The antiderivative of the motion in double precision (falling_leaves.md, 3.2).
struct Place {
  std::complex<double> horizontal;
  double height;
};
Place closedForm(std::uint32_t motion, const LeafTraits& leaf, double t) {
  const MotionShape s = shapeOf(motion);
  const double omega = 2 * std::numbers::pi * static_cast<double>(leaf.flutter);
  const double v = static_cast<double>(leaf.speed), chi = static_cast<double>(leaf.chirality);
  std::complex<double> h = static_cast<double>(s.drift) * t;
  const auto orbit = [&](float radius, float frequency) {
    if (frequency == 0) return std::complex<double>(0);
    const double w = static_cast<double>(frequency) * omega * chi;
    return std::complex<double>(0, -static_cast<double>(radius) / w) * std::exp(std::complex<double>(0, w * t));
  };
  h += orbit(s.radius1, s.frequency1) + orbit(s.radius2, s.frequency2);
  h *= std::complex<double>(static_cast<double>(leaf.headingX), static_cast<double>(leaf.headingZ));
  const double wy = static_cast<double>(s.bobFrequency) * omega;
  return {v * h, v * (-static_cast<double>(s.descent) * t - static_cast<double>(s.bob) / wy * std::cos(wy * t))};
}

}  // namespace

TEST_CASE("a leaf of 0.10 kg/m2 has a terminal speed of 1.18 m/s") {
  CHECK(terminalSpeed(0.10f) == doctest::Approx(1.18).epsilon(0.0085));
  CHECK(terminalSpeed(0.05f) == doctest::Approx(0.84).epsilon(0.01));
  CHECK(terminalSpeed(0.30f) == doctest::Approx(2.05).epsilon(0.01));
}

TEST_CASE("the six motions have the speeds, excursions and tilts of the method's table") {
  const struct {
    std::uint32_t motion;
    double descent, rms, most, radius, meanTilt;
  } table[] = {{kSteady, 1.00, 0.04, 0.05, 0.015, 1},   {kTumbling, 0.80, 0.94, 1.30, 0.010, -1},
               {kChaotic, 0.90, 0.49, 0.80, 0.057, 36}, {kFluttering, 0.75, 0.85, 1.20, 0.115, 45},
               {kHelical, 0.85, 0.58, 0.80, 0.076, 34}, {kSpiralling, 0.95, 0.55, 0.55, 0.066, 25}};
  const LeafTraits leaf = tableLeaf();
  for (const auto& row : table) {
    CAPTURE(row.motion);
    const double dt = 1e-3;
    const int steps = 200000;
    double fall = 0, square = 0, most = 0, tilt = 0, x = 0, z = 0, radius = 0;
    std::vector<std::pair<double, double>> path;
    const auto drift = static_cast<double>(shapeOf(row.motion).drift);
    for (int k = 0; k < steps; ++k) {
      const MotionSample sample = motionAt(row.motion, leaf, static_cast<float>((k + 0.5) * dt));
      const auto vx = static_cast<double>(sample.velocity.x), vz = static_cast<double>(sample.velocity.z);
      fall -= static_cast<double>(sample.velocity.y) / steps;
      square += (vx * vx + vz * vz) / steps;
      most = std::max(most, std::hypot(vx, vz));
      const vec3 n = normalFor(sample.acceleration, sample.most);
      tilt += std::atan2(std::hypot(n.x, n.z), n.y) * 180 / std::numbers::pi / steps;
      path.emplace_back(x += (vx - drift) * dt, z += vz * dt);
    }
    double mx = 0, mz = 0;
    for (const auto& [px, pz] : path) mx += px / steps, mz += pz / steps;
    for (const auto& [px, pz] : path) radius = std::max(radius, std::hypot(px - mx, pz - mz));
    CHECK(fall == doctest::Approx(row.descent).epsilon(0.01));
    CHECK(std::sqrt(square) == doctest::Approx(row.rms).epsilon(0.02).scale(0.5));
    CHECK(most == doctest::Approx(row.most).epsilon(0.02).scale(0.5));
    CHECK(std::abs(radius - row.radius) < 0.05 * row.radius + 0.0005);
    // The table's tilts are before the limit of 75 degrees.
    if (row.meanTilt >= 0) CHECK(std::abs(tilt - row.meanTilt) < 2.5);
  }
}

TEST_CASE("midpoint steps at 60 Hz follow the closed form within 1.5 mm for 2 s, mean velocities exactly") {
  const LeafTraits leaf{1.0f, kFlutterRate / 0.04f, 0.6f, 0.8f, -1.0f};
  for (const float span : {0.0f, 1.0f / 60}) {
    for (std::uint32_t motion = 0; motion < kLeafMotions; ++motion) {
      CAPTURE(motion);
      const Place start = closedForm(motion, leaf, 0);
      std::complex<double> h = start.horizontal;
      double y = start.height, worst = 0;
      for (int k = 0; k < 120; ++k) {
        const vec3 v = motionAt(motion, leaf, (static_cast<float>(k) + 0.5f) / 60.0f, span).velocity;
        h += std::complex<double>(static_cast<double>(v.x), static_cast<double>(v.z)) / 60.0;
        y += static_cast<double>(v.y) / 60.0;
        const Place right = closedForm(motion, leaf, (k + 1) / 60.0);
        worst = std::max(worst, std::hypot(std::abs(h - right.horizontal), y - right.height));
      }
      CHECK(worst <= (span > 0 ? 1e-5 : 1.5e-3));
    }
  }
}

TEST_CASE("acceleration is the derivative of velocity") {
  const LeafTraits leaf{1.3f, 2.0f, 0.6f, 0.8f, -1.0f};
  for (std::uint32_t motion = 0; motion < kLeafMotions; ++motion) {
    for (float t = 0.1f; t < 3; t += 0.37f) {
      const float h = 1.0f / 1024;
      const vec3 numeric = (motionAt(motion, leaf, t + h).velocity - motionAt(motion, leaf, t - h).velocity) / (2 * h);
      CHECK(glm::length(numeric - motionAt(motion, leaf, t).acceleration) <
            0.01f * (1 + glm::length(motionAt(motion, leaf, t).acceleration)));
    }
  }
}

TEST_CASE("a fluttering leaf tilts with its place and not with its velocity") {
  const LeafTraits leaf = tableLeaf();
  std::vector<double> tilt, x, vx;
  for (int k = 0; k < 6000; ++k) {
    const double t = k * 1e-3;
    const MotionSample sample = motionAt(kFluttering, leaf, static_cast<float>(t));
    const vec3 n = normalFor(sample.acceleration, sample.most);
    // The edge on the far side is up: the normal leans back.
    tilt.push_back(-std::atan2(static_cast<double>(n.x), static_cast<double>(n.y)));
    x.push_back(closedForm(kFluttering, leaf, t).horizontal.real());
    vx.push_back(static_cast<double>(sample.velocity.x));
    CHECK(std::abs(tilt.back()) < 75.1 * std::numbers::pi / 180);
  }
  CHECK(correlation(tilt, x) > 0.95);
  CHECK(std::abs(correlation(tilt, vx)) < 0.15);
}

TEST_CASE("a spiralling leaf leans to the axis by 25 degrees") {
  const LeafTraits leaf = tableLeaf();
  for (float t = 0; t < 2; t += 0.01f) {
    const MotionSample sample = motionAt(kSpiralling, leaf, t);
    const Place place = closedForm(kSpiralling, leaf, static_cast<double>(t));
    const vec4 turn = normalized(motionTurn(kSpiralling, leaf, sample));
    const vec3 n = rotate(turn, vec3(0, 1, 0));
    CHECK(glm::dot(turn, turn) == doctest::Approx(1).epsilon(1e-3));
    CHECK(static_cast<double>(n.x) * place.horizontal.real() + static_cast<double>(n.z) * place.horizontal.imag() < 0);
    const double tilt = std::acos(static_cast<double>(n.y)) * 180 / std::numbers::pi;
    CHECK(tilt == doctest::Approx(25.2).epsilon(0.05));
  }
}

TEST_CASE("leaves turn as leaves do, where the published code never turned them") {
  // The published torque, with |v|^4 and displacements for velocities, came to 1.7e-8 /s2 and 1.3e-9 rad/s.
  const LeafTraits leaf = tableLeaf();
  for (const std::uint32_t motion : {kTumbling, kChaotic, kFluttering, kHelical, kSpiralling}) {
    const float h = 1.0f / 512;
    float most = 0;
    for (float t = 0; t < 2; t += h) {
      const auto turnAt = [&](float at) {
        return leafTurn(normalized(motionTurn(motion, leaf, motionAt(motion, leaf, at))), yawRate(motion, leaf) * at,
                        false, false);
      };
      const vec4 change = compose(turnAt(t + h), inverse(turnAt(t)));
      most = std::max(most, 2 * glm::length(vec3(change)) / h);
    }
    CHECK(most > 1.1f);
    CHECK(most < 120.0f);
  }
}
