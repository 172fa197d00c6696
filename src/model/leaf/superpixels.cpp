#include "model/leaf/superpixels.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>

namespace windfall::model {

namespace {

constexpr double kCompactness = 0.12;  // distance runs from 0 to 1
constexpr int kRounds = 5;

struct Centre {
  double x = 0, y = 0, value = 0;
};

}  // namespace

LabelField makeSuperpixels(const ScalarField& distance, const LabelField& regions, int count) {
  const int width = distance.size.width(), height = distance.size.height();
  const auto at = [width](int x, int y) {
    return static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x);
  };
  size_t area = 0;
  for (const qint32 region : regions.values) area += region > 0;
  LabelField labels{distance.size, std::vector<qint32>(distance.values.size(), 0), 0};
  if (area == 0) return labels;
  const double spacing = std::max(1.5, std::sqrt(static_cast<double>(area) / std::max(1, count)));
  std::vector<Centre> centres;
  for (double y = spacing / 2; y < height; y += spacing) {
    for (double x = spacing / 2; x < width; x += spacing) {
      const size_t i = at(static_cast<int>(x), static_cast<int>(y));
      if (regions.values[i] > 0) centres.push_back({x, y, distance.values[i]});
    }
  }
  if (centres.empty()) {
    const auto first =
        static_cast<size_t>(std::find_if(regions.values.begin(), regions.values.end(), [](qint32 r) { return r > 0; }) -
                            regions.values.begin());
    const size_t row = first / static_cast<size_t>(width), column = first % static_cast<size_t>(width);
    centres.push_back({static_cast<double>(column), static_cast<double>(row), distance.values[first]});
  }
  const double weight = kCompactness * kCompactness / (spacing * spacing);
  std::vector<float> nearest(distance.values.size());
  for (int round = 0; round < kRounds; ++round) {
    std::fill(nearest.begin(), nearest.end(), 1e30f);
    for (size_t k = 0; k < centres.size(); ++k) {
      const Centre& centre = centres[k];
      const int left = std::max(0, static_cast<int>(centre.x - spacing)),
                right = std::min(width - 1, static_cast<int>(centre.x + spacing));
      const int top = std::max(0, static_cast<int>(centre.y - spacing)),
                bottom = std::min(height - 1, static_cast<int>(centre.y + spacing));
      for (int y = top; y <= bottom; ++y) {
        for (int x = left; x <= right; ++x) {
          const size_t i = at(x, y);
          if (regions.values[i] <= 0) continue;
          const double dv = distance.values[i] - centre.value, dx = x - centre.x, dy = y - centre.y;
          const auto d = static_cast<float>(dv * dv + weight * (dx * dx + dy * dy));
          if (d < nearest[i]) {
            nearest[i] = d;
            labels.values[i] = static_cast<qint32>(k + 1);
          }
        }
      }
    }
    if (round + 1 == kRounds) break;
    std::vector<Centre> sums(centres.size());
    std::vector<int> counts(centres.size(), 0);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const size_t i = at(x, y);
        if (labels.values[i] <= 0) continue;
        const auto k = static_cast<size_t>(labels.values[i] - 1);
        sums[k].x += x, sums[k].y += y, sums[k].value += distance.values[i];
        ++counts[k];
      }
    }
    for (size_t k = 0; k < centres.size(); ++k) {
      if (counts[k] > 0) centres[k] = {sums[k].x / counts[k], sums[k].y / counts[k], sums[k].value / counts[k]};
    }
  }
  // Pixels that no window reached follow a neighbour, breadth first.
  std::deque<size_t> queue;
  for (size_t i = 0; i < labels.values.size(); ++i) {
    if (labels.values[i] > 0) queue.push_back(i);
  }
  while (!queue.empty()) {
    const size_t i = queue.front();
    queue.pop_front();
    const int x = static_cast<int>(i % static_cast<size_t>(width)),
              y = static_cast<int>(i / static_cast<size_t>(width));
    for (const auto& [dx, dy] : {std::pair(1, 0), std::pair(-1, 0), std::pair(0, 1), std::pair(0, -1)}) {
      if (x + dx < 0 || y + dy < 0 || x + dx >= width || y + dy >= height) continue;
      const size_t next = at(x + dx, y + dy);
      if (regions.values[next] <= 0 || labels.values[next] > 0) continue;
      labels.values[next] = labels.values[i];
      queue.push_back(next);
    }
  }
  // Islands that nothing touches, and labels that ended empty: numbers without gaps.
  std::vector<qint32> number(centres.size() + 1, 0);
  for (size_t i = 0; i < labels.values.size(); ++i) {
    if (regions.values[i] > 0 && labels.values[i] == 0) labels.values[i] = 1;
    if (labels.values[i] > 0 && number[static_cast<size_t>(labels.values[i])] == 0) {
      number[static_cast<size_t>(labels.values[i])] = ++labels.count;
    }
  }
  for (qint32& label : labels.values) label = number[static_cast<size_t>(label)];
  return labels;
}

std::vector<SuperpixelMean> describeSuperpixels(const LeafStructure& structure, const float* lab) {
  std::vector<SuperpixelMean> means(static_cast<size_t>(structure.superpixels.count));
  std::vector<std::map<qint32, int>> regions(means.size());
  for (size_t i = 0; i < structure.superpixels.values.size(); ++i) {
    if (structure.superpixels.values[i] <= 0) continue;
    const auto k = static_cast<size_t>(structure.superpixels.values[i] - 1);
    SuperpixelMean& mean = means[k];
    mean.distance += structure.distance.values[i];
    mean.veinDistance += structure.veinDistance.values[i];
    for (size_t c = 0; lab && c < 3; ++c) mean.lab[c] += lab[3 * i + c];
    ++regions[k][structure.regions.values[i]];
    ++mean.area;
  }
  for (size_t k = 0; k < means.size(); ++k) {
    SuperpixelMean& mean = means[k];
    if (mean.area == 0) continue;
    const auto share = 1 / static_cast<float>(mean.area);
    mean.distance *= share;
    mean.veinDistance *= share;
    for (float& c : mean.lab) c *= share;
    int most = 0;
    for (const auto& [region, pixels] : regions[k]) {
      if (pixels > most) most = pixels, mean.region = region;
    }
  }
  return means;
}

}  // namespace windfall::model
