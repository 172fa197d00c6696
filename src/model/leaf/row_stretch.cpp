#include <algorithm>
#include <cmath>

#include "model/leaf/quality.h"

namespace windfall::model {

namespace {

/// A leaf cut into rows across the line from root to tip: how far it reaches in each. The petiole counts as part of the
/// first row of the blade: stretched to the blade's width it would be nothing but streaks.
class Rows {
 public:
  static constexpr int kCount = 512;
  static constexpr double kPetiole = 0.15;  ///< narrower than this share of the widest row

  Rows(const LeafStructure& structure, const std::array<QPointF, 2>& axis) : structure_(structure), root_(axis[0]) {
    const QPointF way = axis[1] - axis[0];
    const double length = std::max(1.0, std::hypot(way.x(), way.y()));
    along_ = way / length;
    low_.assign(kCount, 1e9);
    high_.assign(kCount, -1e9);
    for (int y = 0; y < height(); ++y) {
      for (int x = 0; x < width(); ++x) {
        if (!inside(x, y)) continue;
        const double t = dot(x, y);
        first_ = std::min(first_, t), last_ = std::max(last_, t);
      }
    }
    for (int y = 0; y < height(); ++y) {
      for (int x = 0; x < width(); ++x) {
        if (!inside(x, y)) continue;
        const auto row = static_cast<size_t>(rowOf(x, y));
        const double across = cross(x, y);
        low_[row] = std::min(low_[row], across), high_[row] = std::max(high_[row], across);
      }
    }
    double widest = 0;
    for (size_t row = 0; row < kCount; ++row) widest = std::max(widest, high_[row] - low_[row]);
    while (blade_ + 1 < kCount / 2 && high_[blade_] - low_[blade_] < kPetiole * widest) ++blade_;
    for (size_t row = 1; row < kCount; ++row) {
      if (low_[row] > high_[row]) low_[row] = low_[row - 1], high_[row] = high_[row - 1];
    }
    for (size_t row = kCount - 1; row-- > 0;) {
      if (low_[row] > high_[row]) low_[row] = low_[row + 1], high_[row] = high_[row + 1];
    }
  }

  int width() const { return structure_.distance.size.width(); }
  int height() const { return structure_.distance.size.height(); }
  bool inside(int x, int y) const {
    return x >= 0 && y >= 0 && x < width() && y < height() &&
           structure_.regions.values[static_cast<size_t>(y) * static_cast<size_t>(width()) + static_cast<size_t>(x)] >
               0;
  }

  /// Where a pixel lies: 0..1 along the leaf, 0..1 across it.
  std::array<double, 2> shareOf(int x, int y) const {
    const auto row = static_cast<size_t>(rowOf(x, y));
    const double span = std::max(1.0, high_[row] - low_[row]), blade = static_cast<double>(blade_) / (kCount - 1);
    const double along = (dot(x, y) - first_) / std::max(1.0, last_ - first_);
    return {std::max(0.0, (along - blade) / (1 - blade)), (cross(x, y) - low_[row]) / span};
  }
  QPointF placeOf(const std::array<double, 2>& share) const {
    const double blade = static_cast<double>(blade_) / (kCount - 1), along = blade + share[0] * (1 - blade);
    const auto row = static_cast<size_t>(std::clamp(along, 0.0, 1.0) * (kCount - 1));
    const double t = first_ + along * (last_ - first_), across = low_[row] + share[1] * (high_[row] - low_[row]);
    return root_ + along_ * t + QPointF(-along_.y(), along_.x()) * across;
  }

 private:
  double dot(int x, int y) const { return (x - root_.x()) * along_.x() + (y - root_.y()) * along_.y(); }
  double cross(int x, int y) const { return (y - root_.y()) * along_.x() - (x - root_.x()) * along_.y(); }
  int rowOf(int x, int y) const {
    return std::clamp(static_cast<int>((dot(x, y) - first_) / std::max(1.0, last_ - first_) * (kCount - 1)), 0,
                      kCount - 1);
  }

  const LeafStructure& structure_;
  QPointF root_, along_;
  double first_ = 1e9, last_ = -1e9;
  size_t blade_ = 0;  ///< the first row of the blade
  std::vector<double> low_, high_;
};

}  // namespace

std::vector<float> stretchRows(const LeafStructure& target, const std::array<QPointF, 2>& targetAxis,
                               const ScoredLeaf& example, const std::array<QPointF, 2>& exampleAxis) {
  const Rows to(target, targetAxis), from(*example.structure, exampleAxis);
  std::vector<float> result(3 * target.distance.values.size(), 0.f);
  for (int y = 0; y < to.height(); ++y) {
    for (int x = 0; x < to.width(); ++x) {
      if (!to.inside(x, y)) continue;
      const QPointF place = from.placeOf(to.shareOf(x, y));
      // Beside a notch of the example its colours are spread outwards already.
      const int ex = std::clamp(static_cast<int>(std::lround(place.x())), 0, from.width() - 1),
                ey = std::clamp(static_cast<int>(std::lround(place.y())), 0, from.height() - 1);
      const size_t e = static_cast<size_t>(ey) * static_cast<size_t>(from.width()) + static_cast<size_t>(ex),
                   t = static_cast<size_t>(y) * static_cast<size_t>(to.width()) + static_cast<size_t>(x);
      for (size_t c = 0; c < 3; ++c) result[3 * t + c] = example.lab[3 * e + c];
    }
  }
  return result;
}

}  // namespace windfall::model
