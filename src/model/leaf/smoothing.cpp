#include "model/leaf/smoothing.h"

#include <algorithm>
#include <cmath>

namespace windfall::model {

int sweepsFor(double w1) {
  const double jacobi = 4 * w1 / (1 + 4 * w1);
  const double omega = 2 / (1 + std::sqrt(1 - jacobi * jacobi));
  const double rate = std::max(1e-3, omega - 1);
  return std::clamp(static_cast<int>(std::ceil(std::log(1e-6) / std::log(rate))) + 6, 8, 200);
}

void smooth(std::vector<float>& values, const std::vector<unsigned char>& mask, QSize size, double w1, int sweeps) {
  if (w1 <= 0) return;
  const std::vector<float> start = values;
  const int width = size.width(), height = size.height();
  const double jacobi = 4 * w1 / (1 + 4 * w1);
  const auto omega = static_cast<float>(2 / (1 + std::sqrt(1 - jacobi * jacobi)));
  const auto weight = static_cast<float>(w1);
  for (int sweep = 0; sweep < 2 * sweeps; ++sweep) {
    const int colour = sweep & 1;
#pragma omp parallel for schedule(static)
    for (int y = 0; y < height; ++y) {
      for (int x = (y + colour) & 1; x < width; x += 2) {
        const size_t i = static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x);
        if (!mask[i]) continue;
        float sum[3] = {0, 0, 0};
        float neighbours = 0;
        const auto add = [&](size_t j) {
          if (!mask[j]) return;
          for (size_t c = 0; c < 3; ++c) sum[c] += values[3 * j + c];
          neighbours += 1;
        };
        if (x > 0) add(i - 1);
        if (x + 1 < width) add(i + 1);
        if (y > 0) add(i - static_cast<size_t>(width));
        if (y + 1 < height) add(i + static_cast<size_t>(width));
        for (size_t c = 0; c < 3; ++c) {
          float& value = values[3 * i + c];
          const float solved = (start[3 * i + c] + weight * sum[c]) / (1 + weight * neighbours);
          value += omega * (solved - value);
        }
      }
    }
  }
}

}  // namespace windfall::model
