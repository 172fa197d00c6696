// V1 and V2 of tree_dynamics.md, 11: the joint's oscillator, stepped exactly.
#include "kernels/link_oscillator.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace windfall;

namespace {

constexpr double kTurn = 2 * std::numbers::pi;

/// y from y = 1, y' = 0 without load at time t.
double exactAt(double omega, double zeta, double t) {
  const double b = zeta * omega;
  if (zeta < 1) {
    const double w = omega * std::sqrt(1 - zeta * zeta);
    return std::exp(-b * t) * (std::cos(w * t) + b / w * std::sin(w * t));
  }
  if (zeta > 1) {
    const double s = omega * std::sqrt(zeta * zeta - 1), slow = omega * omega / (b + s), fast = b + s;
    return (fast * std::exp(-slow * t) - slow * std::exp(-fast * t)) / (fast - slow);
  }
  return std::exp(-b * t) * (1 + b * t);
}

/// Largest error over ten seconds with coefficients in double precision and a state of T.
template <class T>
double largestError(double frequency, double zeta, double h) {
  const double omega = kTurn * frequency;
  const OscillatorStep<double> exact = oscillatorStep(omega * omega, zeta * omega, h);
  const OscillatorStep<T> step{T(exact.stay), T(exact.gain * omega), T(exact.keep), T(exact.pull / omega)};
  T y = 1, v = 0;  // v in units of omega
  double largest = 0;
  for (int i = 1; i <= static_cast<int>(10 / h); ++i) {
    const T next = y * step.stay + v * step.gain;
    v = v * step.keep - y * step.pull;
    y = next;
    largest = std::max(largest, std::abs(static_cast<double>(y) - exactAt(omega, zeta, i * h)));
  }
  return largest;
}

}  // namespace

TEST_CASE("V1: an oscillator of any frequency and damping is stepped exactly, however long the step") {
  double worst = 0, worstFloat = 0;
  for (const double frequency : {0.3, 1.0, 7.0, 50.0, 300.0, 1000.0}) {
    for (const double zeta : {0.0, 0.02, 0.05, 0.5, 0.999999, 1.0, 1.000001, 2.0, 5.0}) {
      for (const double h : {1.0 / 60, 0.1, 1.0}) {
        CAPTURE(frequency);
        CAPTURE(zeta);
        CAPTURE(h);
        // The phase itself is only known to the rounding of omega t.
        const double phase = 2.3e-16 * kTurn * frequency * 10 * (zeta == 0 ? 600 * h : std::min(10.0, 1 / zeta));
        const double error = largestError<double>(frequency, zeta, h);
        CHECK(error <= 2e-14 + phase + (std::abs(zeta - 1) < 1e-3 ? 1e-10 : 0));
        if (zeta >= 0.05 && std::abs(zeta - 1) > 1e-3) worst = std::max(worst, error);
        const double single = largestError<float>(frequency, zeta, h);
        CHECK(single <= (zeta >= 0.05 ? 8e-6 : 6e-5));
        worstFloat = std::max(worstFloat, zeta >= 0.05 ? single : 0);
      }
    }
  }
  CHECK(worst <= 2e-14);
  MESSAGE("largest error with damping 0.05 and more: ", worst, " in double, ", worstFloat, " in single precision");
}

TEST_CASE("the oscillator in single precision is that in double, up to its rounding") {
  for (const float frequency : {0.5f, 5.f, 40.f}) {
    for (const float zeta : {0.03f, 1.f, 3.f}) {
      const float omega = 6.2831853f * frequency;
      const OscillatorStep<float> a = oscillatorStep(omega * omega, zeta * omega, 1.f / 60);
      const OscillatorStep<double> b = oscillatorStep(static_cast<double>(omega * omega),
                                                      static_cast<double>(zeta * omega), static_cast<double>(1.f / 60));
      CHECK(static_cast<double>(a.stay) == doctest::Approx(b.stay).epsilon(3e-6));
      CHECK(static_cast<double>(a.gain) == doctest::Approx(b.gain).epsilon(1e-5));
      CHECK(static_cast<double>(a.keep) == doctest::Approx(b.keep).epsilon(1e-5));
      CHECK(static_cast<double>(a.pull) == doctest::Approx(b.pull).epsilon(1e-5));
    }
  }
}

TEST_CASE("V2: the load of the middle of a step makes the step of second order") {
  // A joint of 0.7 Hz driven at 0.5 Hz to an amplitude of 0.284 rad.
  const double omega = kTurn * 0.7, drive = kTurn * 0.5, zeta = 0.05;
  const double a = omega * omega - drive * drive, c = 2 * zeta * omega * drive;
  const double load = 0.284 * std::sqrt(a * a + c * c) / (omega * omega);
  const auto errorOf = [&](double h, double at) {
    const OscillatorStep<double> step = oscillatorStep(omega * omega, zeta * omega, h);
    double y = 0, v = 0, largest = 0;
    for (int i = 0; i < static_cast<int>(130 / h); ++i) {
      const double balance = load * std::sin(drive * (i + at) * h), e = y - balance;
      y = balance + e * step.stay + v * step.gain;
      v = v * step.keep - e * step.pull;
      const double t = (i + 1) * h;
      const double steady = 0.284 * std::sin(drive * t - std::atan2(c, a));
      if (t > 110) largest = std::max(largest, std::abs(y - steady));
    }
    return largest;
  };
  const double start60 = errorOf(1.0 / 60, 0), mid60 = errorOf(1.0 / 60, 0.5);
  const double start30 = errorOf(1.0 / 30, 0), mid30 = errorOf(1.0 / 30, 0.5);
  MESSAGE("start ", start30, " ", start60, ", middle ", mid30, " ", mid60);
  CHECK(start60 == doctest::Approx(8.4e-3).epsilon(0.2));
  CHECK(mid60 < 1.5 * 5.1e-5);
  CHECK(start30 / start60 == doctest::Approx(2).epsilon(0.02));
  CHECK(mid30 / mid60 == doctest::Approx(4).epsilon(0.02));
}

TEST_CASE("V12: the thesis's scheme diverges, and why") {
  // Three bones in a light wind of 3 m/s at 60 frames a second (3, 4 of the note): the restoring force is crossed with
  // the bone, which turns it by a right angle; its torque F x c bends into the wind; a child adds its parent's angle.
  struct Bone {
    V3<double> angle{}, speed{};
  };
  const auto largest = [](bool accumulate, bool rightWay) {
    Bone bones[3];
    const double length = 1, radius = 0.03, density = 900, modulus = 6e9;
    const double k = modulus * std::numbers::pi * std::pow(radius, 4) / (4 * length);
    const double mass = density * std::numbers::pi * radius * radius * length, inertia = mass * length * length / 3;
    const V3<double> along{0, 0, length / 2}, wind{0.5 * 1.2 * 2 * radius * length * 9, 0, 0};
    double size = 0;
    for (int frame = 0; frame < 60; ++frame) {
      for (int i = 0; i < 3; ++i) {
        Bone& b = bones[i];
        const double a = std::sqrt(dotOf(b.angle, b.angle));
        const V3<double> axis = a > 0 ? b.angle * (1 / a) : V3<double>{};
        const V3<double> c =
            along * std::cos(a) + crossOf(axis, along) * std::sin(a) + axis * (dotOf(axis, along) * (1 - std::cos(a)));
        const V3<double> spring = b.angle * (-k);
        const V3<double> torque =
            rightWay ? spring + crossOf(c, wind) : crossOf(spring * (2 / length), c) + crossOf(wind, c);
        const V3<double> acceleration = torque * (1 / inertia);
        const double h = 1.0 / 60;
        // (16), (17): the angle goes on with the old speed.
        b.angle = b.angle + b.speed * h + acceleration * (0.5 * h * h);
        b.speed = b.speed + acceleration * h;
        if (accumulate && i > 0) b.angle = b.angle + bones[i - 1].angle;
        size = std::max(size, std::sqrt(dotOf(b.angle, b.angle)));
        if (!(size < 1e6)) return size;
      }
    }
    return size;
  };
  CHECK(largest(true, false) > 10);
  CHECK(largest(false, false) > 10);
  // The right torque does not save the explicit integrator.
  CHECK(largest(false, true) > 10);
}
