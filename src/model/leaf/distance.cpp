#include "model/leaf/distance.h"

#include <algorithm>
#include <array>
#include <opencv2/imgproc.hpp>

namespace windfall::model {

namespace {

/// The share-th smallest of the values; 0 of none.
template <class T>
T quantile(std::vector<T> values, double share) {
  if (values.empty()) return T{};
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

}  // namespace

std::vector<std::int32_t> structuralDistance(const std::vector<Tissue>& types, QSize size, QPoint source,
                                             const DistanceCosts& wanted) {
  const auto limited = [](int cost) { return std::clamp(cost, 1, 1000); };
  const DistanceCosts costs{limited(wanted.veinVein), limited(wanted.veinTissue), limited(wanted.tissueTissue)};
  const int width = size.width(), height = size.height();
  std::vector<std::int32_t> distance(types.size(), -1);
  const int highest = 14 * std::max({costs.veinVein, costs.veinTissue, costs.tissueTissue});
  std::vector<std::vector<std::int32_t>> ring(static_cast<size_t>(highest) + 1);
  const std::int32_t start = source.y() * width + source.x();
  if (source.x() < 0 || source.y() < 0 || source.x() >= width || source.y() >= height) return distance;
  distance[static_cast<size_t>(start)] = 0;
  ring[0].push_back(start);
  std::vector<char> settled(types.size(), 0);
  size_t waiting = 1;
  std::vector<std::int32_t> bucket;
  for (std::int64_t now = 0; waiting > 0; ++now) {
    auto& slot = ring[static_cast<size_t>(now % static_cast<std::int64_t>(ring.size()))];
    if (slot.empty()) continue;
    bucket.swap(slot);
    slot.clear();
    waiting -= bucket.size();
    for (const std::int32_t here : bucket) {
      if (settled[static_cast<size_t>(here)] || distance[static_cast<size_t>(here)] != now) continue;
      settled[static_cast<size_t>(here)] = 1;
      const int x = here % width, y = here / width;
      const bool onVein = types[static_cast<size_t>(here)] == Tissue::Vein;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const int nx = x + dx, ny = y + dy;
          if ((dx == 0 && dy == 0) || nx < 0 || ny < 0 || nx >= width || ny >= height) continue;
          const std::int32_t next = ny * width + nx;
          const Tissue type = types[static_cast<size_t>(next)];
          if (type == Tissue::Outside || settled[static_cast<size_t>(next)]) continue;
          // Nothing flows back cheaply: from tissue to vein costs as much as within tissue.
          const int kind = !onVein ? costs.tissueTissue : type == Tissue::Vein ? costs.veinVein : costs.veinTissue;
          const auto reached = static_cast<std::int32_t>(now + (dx != 0 && dy != 0 ? 14 : 10) * kind);
          auto& known = distance[static_cast<size_t>(next)];
          if (known >= 0 && known <= reached) continue;
          known = reached;
          ring[static_cast<size_t>(reached) % ring.size()].push_back(next);
          ++waiting;
        }
      }
    }
    bucket.clear();
  }
  return distance;
}

ScalarField normalised(const std::vector<std::int32_t>& distance, QSize size, const std::vector<Tissue>& types) {
  std::vector<std::int32_t> reached;
  for (size_t i = 0; i < types.size(); ++i) {
    if (types[i] != Tissue::Outside && distance[i] >= 0) reached.push_back(distance[i]);
  }
  const auto top = static_cast<float>(std::max(1, quantile(std::move(reached), 0.995)));
  ScalarField field{size, std::vector<float>(types.size(), 0.f), static_cast<double>(top)};
  for (size_t i = 0; i < types.size(); ++i) {
    if (types[i] == Tissue::Outside) continue;
    field.values[i] = distance[i] < 0 ? 1.f : std::min(1.f, static_cast<float>(distance[i]) / top);
  }
  return field;
}

ScalarField veinDistanceField(const std::vector<Tissue>& types, QSize size) {
  cv::Mat1b tissue(size.height(), size.width());
  std::transform(types.begin(), types.end(), tissue.begin(),
                 [](Tissue type) { return type == Tissue::Vein ? uchar{0} : uchar{255}; });
  cv::Mat1f distance;
  cv::distanceTransform(tissue, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  std::vector<float> inside;
  auto value = distance.begin();
  for (const Tissue type : types) {
    if (type != Tissue::Outside) inside.push_back(*value);
    ++value;
  }
  const float scale = 1 / (2 * std::max(1e-3f, quantile(std::move(inside), 0.95)));
  ScalarField field{size, std::vector<float>(types.size(), 0.f), 1 / static_cast<double>(scale)};
  value = distance.begin();
  for (size_t i = 0; i < types.size(); ++i, ++value) {
    if (types[i] != Tissue::Outside) field.values[i] = *value * scale;
  }
  return field;
}

}  // namespace windfall::model
