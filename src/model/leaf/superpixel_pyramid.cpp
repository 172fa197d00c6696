#include "model/leaf/superpixel_pyramid.h"

#include <algorithm>
#include <cmath>

namespace windfall::model {

namespace {

constexpr double kCompactness = 0.12;
constexpr int kRounds = 5;

using Places = std::vector<SuperpixelPlace>;

/// Groups superpixels into about `count` by k-means in place and structural distance; each tries the centres that began
/// in its own and the neighbouring cells of a grid. Groups without members go.
std::vector<int> cluster(const Places& fine, int count, int& groups) {
  double area = 0, right = 0, bottom = 0;
  for (const SuperpixelPlace& place : fine) {
    area += place.mean.area;
    right = std::max<double>(right, place.x), bottom = std::max<double>(bottom, place.y);
  }
  const double spacing = std::max(1.0, std::sqrt(area / std::max(1, count)));
  const int columns = static_cast<int>(right / spacing) + 1, rows = static_cast<int>(bottom / spacing) + 1;
  struct Centre {
    double x = 0, y = 0, distance = 0, area = 0;
  };
  const auto cellOf = [&](const SuperpixelPlace& place) {
    return static_cast<size_t>(static_cast<int>(place.y / spacing) * columns + static_cast<int>(place.x / spacing));
  };
  std::vector<Centre> centres(static_cast<size_t>(columns) * static_cast<size_t>(rows));
  std::vector<int> group(fine.size());
  for (size_t i = 0; i < fine.size(); ++i) group[i] = static_cast<int>(cellOf(fine[i]));
  const double weight = kCompactness * kCompactness / (spacing * spacing);
  for (int round = 0; round < kRounds; ++round) {
    std::fill(centres.begin(), centres.end(), Centre{});
    for (size_t i = 0; i < fine.size(); ++i) {
      Centre& c = centres[static_cast<size_t>(group[i])];
      const double share = fine[i].mean.area;
      c.x += share * fine[i].x, c.y += share * fine[i].y;
      c.distance += share * fine[i].mean.distance, c.area += share;
    }
    for (Centre& c : centres) {
      if (c.area > 0) c.x /= c.area, c.y /= c.area, c.distance /= c.area;
    }
    for (size_t i = 0; i < fine.size(); ++i) {
      const int cell = static_cast<int>(cellOf(fine[i])), column = cell % columns, row = cell / columns;
      double best = 1e30;
      for (int y = std::max(0, row - 1); y <= std::min(rows - 1, row + 1); ++y) {
        for (int x = std::max(0, column - 1); x <= std::min(columns - 1, column + 1); ++x) {
          const Centre& c = centres[static_cast<size_t>(y * columns + x)];
          if (c.area <= 0) continue;
          const double ds = fine[i].mean.distance - c.distance, dx = fine[i].x - c.x, dy = fine[i].y - c.y;
          const double d = ds * ds + weight * (dx * dx + dy * dy);
          if (d < best) best = d, group[i] = y * columns + x;
        }
      }
    }
  }
  std::vector<int> number(centres.size(), -1);
  groups = 0;
  for (int& g : group) {
    int& n = number[static_cast<size_t>(g)];
    if (n < 0) n = groups++;
    g = n;
  }
  return group;
}

/// Means of the groups; sets the members' parents.
Places merge(Places& fine, int count) {
  int groups = 0;
  const std::vector<int> group = cluster(fine, count, groups);
  Places coarse(static_cast<size_t>(groups));
  std::vector<std::vector<std::pair<int, int>>> regions(coarse.size());
  for (size_t i = 0; i < fine.size(); ++i) {
    fine[i].parent = group[i];
    SuperpixelPlace& to = coarse[static_cast<size_t>(group[i])];
    const SuperpixelMean& mean = fine[i].mean;
    const auto share = static_cast<float>(mean.area);
    to.x += share * fine[i].x, to.y += share * fine[i].y;
    to.mean.distance += share * mean.distance, to.mean.veinDistance += share * mean.veinDistance;
    for (size_t c = 0; c < 3; ++c) to.mean.lab[c] += share * mean.lab[c];
    to.mean.area += mean.area;
    auto& of = regions[static_cast<size_t>(group[i])];
    const auto known = std::find_if(of.begin(), of.end(), [&](const auto& r) { return r.first == mean.region; });
    if (known != of.end()) {
      known->second += mean.area;
    } else {
      of.emplace_back(mean.region, mean.area);
    }
  }
  for (size_t g = 0; g < coarse.size(); ++g) {
    SuperpixelPlace& place = coarse[g];
    const float share = 1 / static_cast<float>(std::max(1, place.mean.area));
    place.x *= share, place.y *= share;
    place.mean.distance *= share, place.mean.veinDistance *= share;
    for (float& c : place.mean.lab) c *= share;
    int most = 0;
    for (const auto& [region, pixels] : regions[g]) {
      if (pixels > most) most = pixels, place.mean.region = region;
    }
  }
  return coarse;
}

}  // namespace

SuperpixelPyramid buildSuperpixelPyramid(const LeafStructure& structure, const float* lab, int levels) {
  const std::vector<SuperpixelMean> means = describeSuperpixels(structure, lab);
  Places finest(means.size());
  const auto width = static_cast<size_t>(structure.distance.size.width());
  std::vector<double> x(means.size(), 0.0), y(means.size(), 0.0);
  for (size_t i = 0; i < structure.superpixels.values.size(); ++i) {
    if (structure.superpixels.values[i] <= 0) continue;
    const auto k = static_cast<size_t>(structure.superpixels.values[i] - 1);
    const size_t row = i / width;
    x[k] += static_cast<double>(i % width), y[k] += static_cast<double>(row);
  }
  for (size_t k = 0; k < means.size(); ++k) {
    const int area = std::max(1, means[k].area);
    finest[k] = {means[k], static_cast<float>(x[k] / area), static_cast<float>(y[k] / area), -1};
  }
  SuperpixelPyramid pyramid{std::move(finest)};
  const size_t step = levels <= 3 ? 8 : 4;
  for (int level = 1; level < levels && pyramid.front().size() > 1; ++level) {
    Places coarse = merge(pyramid.front(), static_cast<int>(std::max<size_t>(1, pyramid.front().size() / step)));
    pyramid.insert(pyramid.begin(), std::move(coarse));
  }
  return pyramid;
}

LabelField superpixelLevel(const LeafStructure& structure, int level, int levels) {
  const SuperpixelPyramid pyramid = buildSuperpixelPyramid(structure, nullptr, levels);
  const auto wanted = static_cast<size_t>(std::clamp(level, 0, static_cast<int>(pyramid.size()) - 1));
  std::vector<int> ancestor(pyramid.back().size());
  for (size_t k = 0; k < ancestor.size(); ++k) {
    int at = static_cast<int>(k);
    for (size_t n = pyramid.size() - 1; n > wanted; --n) at = pyramid[n][static_cast<size_t>(at)].parent;
    ancestor[k] = at;
  }
  LabelField field{structure.superpixels.size, std::vector<qint32>(structure.superpixels.values.size(), 0),
                   static_cast<int>(pyramid[wanted].size())};
  for (size_t i = 0; i < field.values.size(); ++i) {
    const qint32 label = structure.superpixels.values[i];
    if (label > 0) field.values[i] = ancestor[static_cast<size_t>(label - 1)] + 1;
  }
  return field;
}

}  // namespace windfall::model
