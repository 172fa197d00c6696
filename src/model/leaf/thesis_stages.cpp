#include "model/leaf/thesis_stages.h"

namespace windfall::model {

std::vector<std::int32_t> labelCorrectingDistance(const std::vector<Tissue>& types, QSize size, QPoint source,
                                                  const DistanceCosts& costs) {
  const int width = size.width(), height = size.height();
  std::vector<std::int32_t> distance(types.size(), -1), frontier, next;
  if (source.x() < 0 || source.y() < 0 || source.x() >= width || source.y() >= height) return distance;
  std::vector<char> queued(types.size(), 0);
  frontier.push_back(source.y() * width + source.x());
  distance[static_cast<size_t>(frontier.front())] = 0;
  while (!frontier.empty()) {
    next.clear();
    for (const std::int32_t here : frontier) {
      queued[static_cast<size_t>(here)] = 0;
      const int x = here % width, y = here / width;
      const bool onVein = types[static_cast<size_t>(here)] == Tissue::Vein;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          if ((dx == 0 && dy == 0) || x + dx < 0 || y + dy < 0 || x + dx >= width || y + dy >= height) continue;
          const auto to = static_cast<size_t>((y + dy) * width + x + dx);
          if (types[to] == Tissue::Outside) continue;
          const int kind = !onVein ? costs.tissueTissue : types[to] == Tissue::Vein ? costs.veinVein : costs.veinTissue;
          const std::int32_t reached = distance[static_cast<size_t>(here)] + (dx != 0 && dy != 0 ? 14 : 10) * kind;
          if (distance[to] >= 0 && distance[to] <= reached) continue;
          distance[to] = reached;
          if (!queued[to]) queued[to] = 1, next.push_back(static_cast<std::int32_t>(to));
        }
      }
    }
    frontier.swap(next);
  }
  return distance;
}

void smoothGaussSeidel(std::vector<float>& values, const std::vector<unsigned char>& mask, QSize size, double w1,
                       int sweeps) {
  const std::vector<float> start = values;
  const int width = size.width(), height = size.height();
  const auto weight = static_cast<float>(w1);
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const auto i = static_cast<size_t>(y * width + x);
        if (!mask[i]) continue;
        float sum[3] = {0, 0, 0}, neighbours = 0;
        const auto add = [&](size_t j) {
          if (!mask[j]) return;
          for (size_t c = 0; c < 3; ++c) sum[c] += values[3 * j + c];
          neighbours += 1;
        };
        if (x > 0) add(i - 1);
        if (x + 1 < width) add(i + 1);
        if (y > 0) add(i - static_cast<size_t>(width));
        if (y + 1 < height) add(i + static_cast<size_t>(width));
        for (size_t c = 0; c < 3; ++c)
          values[3 * i + c] = (start[3 * i + c] + weight * sum[c]) / (1 + weight * neighbours);
      }
    }
  }
}

}  // namespace windfall::model
