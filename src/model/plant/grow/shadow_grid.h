// Light by shadows that metamers cast downwards into a grid (Palubicki et al. 2009; growers.md, 2.1).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "model/plant/grow/grown.h"

namespace windfall::model::growth {

/// Whole numbers of 2^-20, so that casting commutes and taking back leaves nothing behind.
class ShadowGrid {
 public:
  /// Voxels of edge `voxel` over |x|, |z| <= `reach` and -1..`top` m. A node adds `amount` * `falloff`^-q to the
  /// (2q+1)^2 voxels q below it, q = 0..`depth`.
  ShadowGrid(double voxel, double reach, double top, double amount, double falloff, int depth)
      : voxel_(voxel), reach_(reach), depth_(depth) {
    across_ = static_cast<int>(2 * reach / voxel) + 1;
    tall_ = static_cast<int>((top + 1) / voxel) + 1;
    shade_.assign(at(across_) * at(across_) * at(tall_), 0);
    for (int q = 0; q <= depth; ++q) weight_.push_back(std::llround(amount * std::pow(falloff, -q) * kOne));
  }

  /// Adds the shadow of a node at `place`; `sign` -1 takes it back.
  void cast(dvec3 place, int sign) {
    const Cell c = cellOf(place);
    for (int q = 0; q <= depth_; ++q) {
      const int y = c.y - q;
      if (y < 0 || y >= tall_) continue;
      const auto weight = static_cast<std::int32_t>(sign * weight_[at(q)]);
      for (int z = std::max(c.z - q, 0); z <= std::min(c.z + q, across_ - 1); ++z) {
        for (int x = std::max(c.x - q, 0); x <= std::min(c.x + q, across_ - 1); ++x) shade_[index(x, y, z)] += weight;
      }
    }
  }

  /// Shadow at a place; outside the grid all is shade, so that nothing grows out of it.
  double shade(dvec3 place) const {
    const Cell c = cellOf(place);
    if (c.x < 0 || c.y < 0 || c.z < 0 || c.x >= across_ || c.z >= across_ || c.y >= tall_) return 1e3;
    return static_cast<double>(shade_[index(c.x, c.y, c.z)]) / kOne;
  }

  /// Sum over all voxels.
  double total() const {
    std::int64_t sum = 0;
    for (const std::int32_t s : shade_) sum += s;
    return static_cast<double>(sum) / kOne;
  }

 private:
  struct Cell {
    int x, y, z;
  };
  static constexpr double kOne = 1048576;
  Cell cellOf(dvec3 p) const {
    return {static_cast<int>(std::floor((p.x + reach_) / voxel_)), static_cast<int>(std::floor((p.y + 1) / voxel_)),
            static_cast<int>(std::floor((p.z + reach_) / voxel_))};
  }
  std::size_t index(int x, int y, int z) const { return (at(z) * at(tall_) + at(y)) * at(across_) + at(x); }

  double voxel_, reach_;
  int depth_, across_ = 0, tall_ = 0;
  std::vector<std::int32_t> shade_;
  std::vector<long long> weight_;
};

}  // namespace windfall::model::growth
