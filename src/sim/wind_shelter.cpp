#include "sim/wind_shelter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace windfall::sim {

namespace {

constexpr float kDrag = 0.15f;       // of leaves per one-sided area (2.4)
constexpr float kMixing = 40;        // m over which a wake fades
constexpr float kFarthest = 100;     // m upwind that is looked at
constexpr int kMostVoxels = 64;      // along each axis
constexpr float kSmallestVoxel = 1;  // m

/// Leaf area per volume on a grid of cubes, 1/m.
struct Voxels {
  vec3 lower{0};
  float size = 1;
  int nx = 0, ny = 0, nz = 0;
  std::vector<float> density;

  explicit Voxels(std::span<const Foliage> foliage) {
    vec3 upper(-1e30f);
    lower = vec3(1e30f);
    for (const Foliage& leaf : foliage) {
      lower = glm::min(lower, leaf.place);
      upper = glm::max(upper, leaf.place);
    }
    const vec3 extent = upper - lower;
    size = std::max(kSmallestVoxel, std::max({extent.x, extent.y, extent.z}) / (kMostVoxels - 1));
    const auto count = [&](float length) { return static_cast<int>(length / size) + 1; };
    nx = count(extent.x), ny = count(extent.y), nz = count(extent.z);
    density.assign(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny) * static_cast<std::size_t>(nz), 0.f);
    const float perVolume = 1 / (size * size * size);
    for (const Foliage& leaf : foliage) {
      if (const std::ptrdiff_t voxel = indexOf(leaf.place); voxel >= 0) {
        density[static_cast<std::size_t>(voxel)] += leaf.area * perVolume;
      }
    }
  }

  /// -1 outside.
  std::ptrdiff_t indexOf(const vec3& place) const {
    const vec3 p = (place - lower) / size;
    if (!(p.x >= 0 && p.y >= 0 && p.z >= 0)) return -1;
    const auto x = static_cast<std::ptrdiff_t>(p.x), y = static_cast<std::ptrdiff_t>(p.y);
    const auto z = static_cast<std::ptrdiff_t>(p.z);
    return x < nx && y < ny && z < nz ? (z * ny + y) * nx + x : -1;
  }

  /// Share of a wind to `direction` that reaches `place`.
  float shareAt(const vec3& place, const vec3& direction) const {
    const vec3 top = lower + size * vec3(nx, ny, nz);
    if (place.y < lower.y - size || place.y > top.y) return 1;
    float depth = 0;
    for (float way = 0.5f * size; way < kFarthest; way += size) {
      const vec3 at = place - direction * way;
      const bool leaving = (direction.x > 0 ? at.x < lower.x : direction.x < 0 && at.x > top.x) ||
                           (direction.z > 0 ? at.z < lower.z : direction.z < 0 && at.z > top.z);
      if (leaving) break;
      const std::ptrdiff_t voxel = indexOf(at);
      if (voxel >= 0) depth += density[static_cast<std::size_t>(voxel)] * size * std::exp(-way / kMixing);
    }
    return std::exp(-0.5f * kDrag * depth);
  }
};

vec3 azimuth(int index) {
  const double angle = 2 * std::numbers::pi * index / ShelterMap::kAzimuths;
  return {static_cast<float>(std::sin(angle)), 0, static_cast<float>(-std::cos(angle))};
}

}  // namespace

ShelterMap::ShelterMap(std::span<const Foliage> foliage, const WindLattice& lattice, int nz, int threads) {
  if (foliage.empty()) return;
  const Voxels voxels(foliage);
  const auto nx = static_cast<std::size_t>(lattice.nx), ny = static_cast<std::size_t>(lattice.ny);
  const std::size_t nodes = nx * ny * static_cast<std::size_t>(nz);
  shares_.resize(nodes * kAzimuths);
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::size_t i = 0; i < nodes; ++i) {
    const std::size_t x = i % nx, y = i / nx % ny, z = i / (nx * ny);
    const vec3 index(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
    const vec3 place = lattice.origin + index * lattice.spacing;
    for (int a = 0; a < kAzimuths; ++a) {
      shares_[i * kAzimuths + static_cast<std::size_t>(a)] =
          static_cast<std::uint8_t>(std::lround(255 * voxels.shareAt(place, azimuth(a))));
    }
  }
}

float ShelterMap::at(std::size_t node, const vec3& direction) const {
  if (shares_.empty()) return 1;
  const float turns = std::atan2(direction.x, -direction.z) * static_cast<float>(0.5 / std::numbers::pi);
  const float position = (turns - std::floor(turns)) * kAzimuths;
  const int first = static_cast<int>(position) % kAzimuths, second = (first + 1) % kAzimuths;
  const float share = position - std::floor(position);
  const std::uint8_t* own = &shares_[node * kAzimuths];
  return (static_cast<float>(own[first]) * (1 - share) + static_cast<float>(own[second]) * share) * (1.f / 255);
}

}  // namespace windfall::sim
