#include "model/leaf/quantiles.h"

#include <algorithm>
#include <cmath>

namespace windfall::model {

std::vector<float> quantiles(std::vector<float> values, int count) {
  std::vector<float> result;
  if (values.empty()) return result;
  std::sort(values.begin(), values.end());
  const auto last = static_cast<double>(values.size() - 1);
  for (int i = 0; i < count; ++i) {
    const double place = (i + 0.5) / count * last;
    const auto below = static_cast<size_t>(place);
    const size_t above = std::min(values.size() - 1, below + 1);
    const auto part = static_cast<float>(place - std::floor(place));
    result.push_back(values[below] * (1 - part) + values[above] * part);
  }
  return result;
}

double wasserstein(const std::vector<float>& a, const std::vector<float>& b) {
  const size_t count = std::min(a.size(), b.size());
  if (count == 0) return 0;
  double sum = 0;
  for (size_t i = 0; i < count; ++i) sum += std::abs(a[i] - b[i]);
  return sum / static_cast<double>(count);
}

}  // namespace windfall::model
