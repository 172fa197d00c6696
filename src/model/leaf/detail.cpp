#include "model/leaf/detail.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace windfall::model {

namespace {

constexpr int kNearest = 24, kPlaces = 5;
/// Weight of veins that lie on veins beside that of colours that continue; and how wide a vein is, of windows of 24.
constexpr float kOnVeins = 300, kVeinWidth = 2;
using Feature = std::array<float, 2 * kPlaces>;

struct Window {
  int x = 0, y = 0;  ///< top left
  Feature feature{};
};

class Layer {
 public:
  Layer(const LeafStructure& structure, int side) : structure_(structure), side_(side) {
    width_ = structure.distance.size.width();
    height_ = structure.distance.size.height();
  }

  bool inside(int x, int y) const {
    return x >= 0 && y >= 0 && x < width_ && y < height_ && structure_.regions.values[index(x, y)] > 0;
  }
  size_t index(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x);
  }
  /// 1 on a vein, falling off within a few pixels beside it.
  float line(size_t i) const {
    const float d = structure_.veinDistance.values[i] * static_cast<float>(structure_.veinDistance.unit) /
                    (kVeinWidth * static_cast<float>(side_) / 24);
    return std::exp(-d * d);
  }
  int width() const { return width_; }
  int height() const { return height_; }

  /// Structural and vein distance at the centre and four places around it; off the leaf the centre's count.
  Feature feature(int left, int top) const {
    const int q = side_ / 4, c = side_ / 2;
    int cx = left + c, cy = top + c;
    if (!inside(cx, cy)) {
      for (const auto& [dx, dy] : {std::pair(-q, 0), std::pair(q, 0), std::pair(0, -q), std::pair(0, q)}) {
        if (inside(cx + dx, cy + dy)) {
          cx += dx, cy += dy;
          break;
        }
      }
    }
    Feature result{};
    const std::array<std::pair<int, int>, kPlaces> places{{{c, c}, {q, q}, {3 * q, q}, {q, 3 * q}, {3 * q, 3 * q}}};
    for (size_t k = 0; k < places.size(); ++k) {
      int x = left + places[k].first, y = top + places[k].second;
      if (!inside(x, y)) x = std::clamp(cx, 0, width_ - 1), y = std::clamp(cy, 0, height_ - 1);
      result[2 * k] = structure_.distance.values[index(x, y)];
      result[2 * k + 1] = 1.5f * structure_.veinDistance.values[index(x, y)];
    }
    return result;
  }

  /// Share of the window that lies on the leaf, from a coarse grid of places.
  double share(int left, int top) const {
    int on = 0;
    for (int j = 0; j < 6; ++j) {
      for (int i = 0; i < 6; ++i) on += inside(left + (2 * i + 1) * side_ / 12, top + (2 * j + 1) * side_ / 12);
    }
    return on / 36.0;
  }

 private:
  const LeafStructure& structure_;
  int side_, width_ = 0, height_ = 0;
};

float squareDistance(const Feature& a, const Feature& b) {
  float sum = 0;
  for (size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

}  // namespace

std::vector<float> layDetail(const LeafStructure& target, const DetailSource& example, RandomSequence& random,
                             Progress& progress) {
  const int longSide = std::max(target.distance.size.width(), target.distance.size.height());
  const int side = std::max(8, 24 * longSide / 512 / 2 * 2), stride = side / 2;
  const Layer to(target, side), from(*example.structure, side);
  std::vector<float> toLine(target.distance.values.size()), fromLine(example.structure->distance.values.size());
  for (size_t i = 0; i < toLine.size(); ++i) toLine[i] = to.line(i);
  for (size_t i = 0; i < fromLine.size(); ++i) fromLine[i] = from.line(i);
  std::vector<Window> sources;
  const int grid = std::max(2, side / 8);
  for (const double least : {0.98, 0.8, 0.4}) {
    for (int y = 0; y + side <= from.height(); y += grid) {
      for (int x = 0; x + side <= from.width(); x += grid) {
        if (from.share(x, y) >= least) sources.push_back({x, y, from.feature(x, y)});
      }
    }
    if (sources.size() >= 64) break;
    sources.clear();
  }
  const size_t pixels = target.distance.values.size();
  std::vector<float> sum(3 * pixels, 0.f), squares(pixels, 0.f);
  if (sources.empty()) return sum;
  std::vector<float> hann(static_cast<size_t>(side));
  for (int i = 0; i < side; ++i) {
    hann[static_cast<size_t>(i)] = static_cast<float>(0.5 - 0.5 * std::cos(2 * std::numbers::pi * (i + 0.5) / side));
  }
  std::vector<std::pair<float, int>> nearest(sources.size());
  for (int top = -stride; top < to.height(); top += stride) {
    progress.report(static_cast<double>(top) / to.height());
    if (progress.cancelled()) return sum;
    for (int left = -stride; left < to.width(); left += stride) {
      if (to.share(left, top) <= 0) continue;
      const Feature feature = to.feature(left, top);
      const int count = std::min(kNearest, static_cast<int>(sources.size()));
      for (size_t k = 0; k < sources.size(); ++k)
        nearest[k] = {squareDistance(feature, sources[k].feature), static_cast<int>(k)};
      std::nth_element(nearest.begin(), nearest.begin() + (count - 1), nearest.end());
      std::sort(nearest.begin(), nearest.begin() + count);
      int chosen = nearest[0].second;
      float bestFit = 1e30f;
      for (int attempt = 0; attempt < count; ++attempt) {
        // Each is left out by chance at times: another seed takes another one.
        if (attempt > 0 && random.below(4) == 0) continue;
        const int candidate = nearest[static_cast<size_t>(attempt)].second;
        const Window& window = sources[static_cast<size_t>(candidate)];
        float fit = 0;
        for (int j = 1; j < side; j += 3) {
          for (int i = 1; i < side; i += 3) {
            if (!to.inside(left + i, top + j)) continue;
            const size_t t = to.index(left + i, top + j), e = from.index(window.x + i, window.y + j);
            const float onVein = toLine[t] - fromLine[e];
            fit += kOnVeins * onVein * onVein;
            if (squares[t] < 0.05f) continue;
            const float norm = 1 / std::sqrt(squares[t]);
            for (size_t c = 0; c < 3; ++c) {
              const float difference = sum[3 * t + c] * norm - (*example.layer)[3 * e + c];
              fit += difference * difference;
            }
          }
        }
        if (fit < bestFit) bestFit = fit, chosen = candidate;
      }
      const Window& window = sources[static_cast<size_t>(chosen)];
      for (int j = 0; j < side; ++j) {
        for (int i = 0; i < side; ++i) {
          if (!to.inside(left + i, top + j)) continue;
          const size_t t = to.index(left + i, top + j), e = from.index(window.x + i, window.y + j);
          const float weight = hann[static_cast<size_t>(i)] * hann[static_cast<size_t>(j)];
          for (size_t c = 0; c < 3; ++c) sum[3 * t + c] += weight * (*example.layer)[3 * e + c];
          squares[t] += weight * weight;
        }
      }
    }
  }
  // A layer of mean zero keeps its variance when the sum is divided by the root of the squared weights.
  for (size_t i = 0; i < pixels; ++i) {
    const float norm = squares[i] > 1e-6f ? 1 / std::sqrt(squares[i]) : 0;
    for (size_t c = 0; c < 3; ++c) sum[3 * i + c] *= norm;
  }
  return sum;
}

}  // namespace windfall::model
