#include "model/leaf/superpixels.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>

namespace windfall::model {

namespace {

constexpr double kCompactness = 0.12;  // distance runs from 0 to 1
constexpr int kRounds = 5;
constexpr double kMostArea = 2.2, kLeastArea = 0.25;  ///< of the mean

struct Centre {
  double x = 0, y = 0, value = 0;
};

/// Calls `visit` for the neighbours of a pixel.
template <class Visit>
void neighbours(QSize size, size_t i, Visit visit) {
  const auto width = static_cast<size_t>(size.width());
  const size_t x = i % width, y = i / width;
  if (x > 0) visit(i - 1);
  if (x + 1 < width) visit(i + 1);
  if (y > 0) visit(i - width);
  if (y + 1 < static_cast<size_t>(size.height())) visit(i + width);
}

/// Pixels that no window reached follow a neighbour, breadth first; a superpixel that grew too large (along a petiole)
/// is followed by a new one, and an island begins one.
void reachAll(LabelField& labels, const LabelField& regions, double most, qint32 last) {
  std::vector<int> areas(static_cast<size_t>(last) + 1, 0);
  std::deque<size_t> queue;
  for (size_t i = 0; i < labels.values.size(); ++i) {
    if (labels.values[i] <= 0) continue;
    ++areas[static_cast<size_t>(labels.values[i])];
    queue.push_back(i);
  }
  const auto begin = [&] {
    areas.push_back(0);
    return static_cast<qint32>(areas.size() - 1);
  };
  for (size_t start = 0; start < labels.values.size() || !queue.empty();) {
    if (queue.empty()) {
      if (regions.values[start] > 0 && labels.values[start] == 0) {
        labels.values[start] = begin();
        queue.push_back(start);
      }
      ++start;
      continue;
    }
    const size_t i = queue.front();
    queue.pop_front();
    neighbours(labels.size, i, [&](size_t next) {
      if (regions.values[next] <= 0 || labels.values[next] > 0) return;
      qint32 label = labels.values[i];
      if (areas[static_cast<size_t>(label)] >= most) label = begin();
      ++areas[static_cast<size_t>(label)];
      labels.values[next] = label;
      queue.push_back(next);
    });
  }
}

/// Superpixels smaller than `least` px become part of the smallest beside them.
void takeInFragments(LabelField& labels, double least) {
  std::vector<int> areas(1, 0);
  for (const qint32 label : labels.values) {
    if (static_cast<size_t>(label) >= areas.size()) areas.resize(static_cast<size_t>(label) + 1, 0);
    ++areas[static_cast<size_t>(label)];
  }
  std::vector<qint32> into(areas.size(), 0);
  for (size_t i = 0; i < labels.values.size(); ++i) {
    const qint32 own = labels.values[i];
    if (own <= 0 || areas[static_cast<size_t>(own)] >= least) continue;
    neighbours(labels.size, i, [&](size_t next) {
      const qint32 other = labels.values[next];
      qint32& best = into[static_cast<size_t>(own)];
      if (other <= 0 || other == own || areas[static_cast<size_t>(other)] < least) return;
      if (best == 0 || areas[static_cast<size_t>(other)] < areas[static_cast<size_t>(best)]) best = other;
    });
  }
  for (qint32& label : labels.values) {
    if (into[static_cast<size_t>(label)] > 0) label = into[static_cast<size_t>(label)];
  }
}

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
  reachAll(labels, regions, kMostArea * spacing * spacing, static_cast<qint32>(centres.size()));
  takeInFragments(labels, kLeastArea * static_cast<double>(area) / std::max(1, count));
  // Labels that ended empty: numbers without gaps.
  std::vector<qint32> number(static_cast<size_t>(*std::max_element(labels.values.begin(), labels.values.end())) + 1, 0);
  for (size_t i = 0; i < labels.values.size(); ++i) {
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
