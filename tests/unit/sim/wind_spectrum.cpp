// V10 of tree_dynamics.md, 11: what a link feels (windAt, not the formula behind it) at 60 Hz.
#include <doctest/doctest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "sim/wind.h"

using namespace windfall;
using namespace windfall::sim;

namespace {

constexpr double kStep = 1.0 / 60;

WindSettings turbulent(std::uint64_t seed, float speed) {
  WindSettings settings;
  settings.speed = speed;
  settings.turbulence = 0.2f;
  settings.gustStrength = 0;
  settings.seed = seed;
  return settings;
}

/// Speed along the wind at places, a series each, of `count` steps.
std::vector<std::vector<double>> record(const WindSettings& settings, const std::vector<vec3>& places, int count) {
  WindField wind(vec3(-8, 0, -8), vec3(8, 12, 8), settings, 1);
  std::vector<std::vector<double>> series(places.size());
  for (int i = 0; i < count; ++i) {
    wind.advance(i * kStep);
    for (std::size_t k = 0; k < places.size(); ++k) {
      series[k].push_back(static_cast<double>(windAt(wind.view(), places[k]).x) - static_cast<double>(settings.speed));
    }
  }
  return series;
}

/// Power of the Hann-windowed series at a frequency, Goertzel's way.
double power(const std::vector<double>& series, std::size_t begin, std::size_t length, double frequency) {
  std::complex<double> sum = 0;
  for (std::size_t i = 0; i < length; ++i) {
    const double phase = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(length);
    const double window = 0.5 - 0.5 * std::cos(phase);
    sum += window * series[begin + i] *
           std::polar(1.0, -2 * std::numbers::pi * frequency * static_cast<double>(i) * kStep);
  }
  return std::norm(sum);
}

double spectralSlope(const std::vector<std::vector<double>>& records, double lowest, double highest) {
  constexpr std::size_t kLength = 1200;
  std::vector<double> x, y;
  for (double frequency = lowest; frequency <= highest; frequency *= 1.06) {
    double sum = 0;
    for (const auto& series : records) {
      for (std::size_t begin = 0; begin + kLength <= series.size(); begin += kLength / 2) {
        sum += power(series, begin, kLength, frequency);
      }
    }
    x.push_back(std::log(frequency));
    y.push_back(std::log(sum));
  }
  double mx = 0, my = 0, xx = 0, xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) mx += x[i], my += y[i];
  mx /= static_cast<double>(x.size()), my /= static_cast<double>(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) xx += (x[i] - mx) * (x[i] - mx), xy += (x[i] - mx) * (y[i] - my);
  return xy / xx;
}

}  // namespace

TEST_CASE("V10: the spectrum falls as Kolmogorov's over 0.25 to 4 Hz") {
  std::vector<std::vector<double>> records;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    for (auto& series : record(turbulent(seed, 8), {vec3(0.3f, 10, -2.2f), vec3(-3.1f, 9, 5.4f)}, 6000)) {
      records.push_back(std::move(series));
    }
  }
  const double slope = spectralSlope(records, 0.25, 4);
  MESSAGE("slope " << slope);
  CHECK(std::abs(slope + 1.81) < 0.15);
}

TEST_CASE("V10: the deviation at a link is the one that was asked for") {
  double square = 0, sum = 0, count = 0;
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    for (const auto& series : record(turbulent(seed, 7), {vec3(0.3f, 10, -2.2f), vec3(-6, 10, 6)}, 3600)) {
      for (const double v : series) sum += v, square += v * v, ++count;
    }
  }
  const double deviation = std::sqrt(square / count - sum * sum / (count * count));
  MESSAGE("deviation " << deviation << " of 1.4");
  CHECK(std::abs(deviation - 1.4) < 0.08 * 1.4);
}

TEST_CASE("V10: eddies reach a place 5 m downwind when the mean wind does (Taylor)") {
  double best = -1, bestLag = 0;
  std::vector<std::vector<std::vector<double>>> all;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    all.push_back(record(turbulent(seed, 6), {vec3(-2.5f, 10, 0.7f), vec3(2.5f, 10, 0.7f)}, 3600));
  }
  for (std::size_t lag = 20; lag <= 90; ++lag) {
    double product = 0, first = 0, second = 0;
    for (const auto& pair : all) {
      for (std::size_t i = 0; i + lag < pair[0].size(); ++i) {
        product += pair[0][i] * pair[1][i + lag];
        first += pair[0][i] * pair[0][i];
        second += pair[1][i + lag] * pair[1][i + lag];
      }
    }
    const double correlation = product / std::sqrt(first * second);
    if (correlation > best) best = correlation, bestLag = static_cast<double>(lag) * kStep;
  }
  MESSAGE("correlation " << best << " at " << bestLag << " s");
  CHECK(best > 0.75);
  CHECK(best < 0.995);  // eddies change on their way
  CHECK(std::abs(bestLag - 5.0 / 6) < 0.1 * 5 / 6);
}
