#include "widgets/plant/frequency.h"

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace windfall::widgets {

double dominantFrequency(std::span<const float> samples, double interval) {
  constexpr std::size_t kFewest = 32;
  constexpr double kStill = 1e-12;
  const std::size_t count = samples.size();
  if (count < kFewest || !(interval > 0)) return 0;
  double mean = 0;
  for (const float sample : samples) mean += static_cast<double>(sample);
  mean /= static_cast<double>(count);
  std::vector<double> windowed(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double hann =
        0.5 - 0.5 * std::cos(2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count));
    windowed[i] = (static_cast<double>(samples[i]) - mean) * hann;
  }
  // A few hundred samples a second or so: the plain sum is quick enough and needs no library. The turning factor is
  // advanced by multiplication.
  std::vector<double> power(count / 2, 0);
  for (std::size_t k = 1; k < power.size(); ++k) {
    const auto turn = std::polar(1.0, -2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(count));
    std::complex<double> sum = 0, phase = 1;
    for (const double value : windowed) {
      sum += value * phase;
      phase *= turn;
    }
    power[k] = std::norm(sum);
  }
  std::size_t peak = 1;
  for (std::size_t k = 2; k < power.size(); ++k) {
    if (power[k] > power[peak]) peak = k;
  }
  if (power[peak] < kStill * static_cast<double>(count)) return 0;
  double bin = static_cast<double>(peak);
  if (peak > 1 && peak + 1 < power.size() && power[peak - 1] > 0 && power[peak + 1] > 0) {
    const double left = std::log(power[peak - 1]), middle = std::log(power[peak]), right = std::log(power[peak + 1]);
    const double bend = left - 2 * middle + right;
    if (bend < 0) bin += 0.5 * (left - right) / bend;
  }
  return bin / (static_cast<double>(count) * interval);
}

}  // namespace windfall::widgets
