#include "sim/wind_eddies.h"

#include <cmath>
#include <map>
#include <mutex>

#include "kernels/random.h"

namespace windfall::sim {

namespace {

constexpr float kFalling = 0.7937005f;  // 2^(-1/3), from one octave to the next
constexpr int kLargestCell = 16;        // nodes

float ease(float t) { return t * t * t * (t * (t * 6 - 15) + 10); }

/// Where a node lies between the noise's own lattice points, for one axis of one octave.
struct Place {
  std::uint32_t cell[2];
  float offset, weight;
};

/// Nodes stand a quarter of a cell aside, since the noise is zero at its own lattice points.
std::vector<Place> placesOf(int nodes, int cell) {
  std::vector<Place> places;
  const int cells = nodes / cell;
  for (int i = 0; i < nodes; ++i) {
    const float at = (static_cast<float>(i) + 0.25f * static_cast<float>(cell)) / static_cast<float>(cell);
    const float base = std::floor(at);
    const int index = static_cast<int>(base);
    places.push_back({{static_cast<std::uint32_t>(index % cells), static_cast<std::uint32_t>((index + 1) % cells)},
                      at - base,
                      ease(at - base)});
  }
  return places;
}

/// The gradients are the corners (+-1, +-1, +-1).
float slopeOf(std::uint32_t bits, float x, float y, float z) {
  return ((bits & 1u) != 0 ? x : -x) + ((bits & 2u) != 0 ? y : -y) + ((bits & 4u) != 0 ? z : -z);
}

void addOctave(std::vector<vec4>& tile, std::uint64_t seed, int octave, int cell, float amplitude) {
  const std::vector<Place> xs = placesOf(kTileX, cell), ys = placesOf(kTileY, cell), zs = placesOf(kTileZ, cell);
  std::size_t i = 0;
  for (const Place& z : zs) {
    for (const Place& y : ys) {
      for (const Place& x : xs) {
        vec3 sum(0);
        for (unsigned corner = 0; corner < 8; ++corner) {
          const unsigned cx = corner & 1u, cy = (corner >> 1u) & 1u, cz = corner >> 2u;
          const std::uint32_t bits = pcg((x.cell[cx] * 0x8da6b343u) ^ (y.cell[cy] * 0xd8163841u) ^
                                         (z.cell[cz] * 0xcb1ab31fu) ^ hash(seed, static_cast<std::uint32_t>(octave)));
          const float dx = x.offset - static_cast<float>(cx), dy = y.offset - static_cast<float>(cy);
          const float dz = z.offset - static_cast<float>(cz);
          const float weight = (cx != 0 ? x.weight : 1 - x.weight) * (cy != 0 ? y.weight : 1 - y.weight) *
                               (cz != 0 ? z.weight : 1 - z.weight);
          sum += weight * vec3(slopeOf(bits >> 8u, dx, dy, dz), slopeOf(bits >> 14u, dx, dy, dz),
                               slopeOf(bits >> 20u, dx, dy, dz));
        }
        tile[i++] += vec4(amplitude * sum, 0);
      }
    }
  }
}

/// Mean 0, and root mean square 1 of what trilinear sampling gives (it smooths: the nodes themselves vary more).
void normalise(std::vector<vec4>& tile) {
  glm::dvec3 mean(0);
  for (const vec4& node : tile) mean += glm::dvec3(node);
  mean /= static_cast<double>(tile.size());
  for (vec4& node : tile) node -= vec4(vec3(mean), 0);
  constexpr int kSamples = 60'000;
  glm::dvec3 square(0);
  for (std::uint32_t i = 0; i < kSamples; ++i) {
    const vec3 p(kTileX * uniform(5, i, 0), kTileY * uniform(5, i, 1), kTileZ * uniform(5, i, 2));
    const glm::dvec3 v(eddyAt(tile.data(), p));
    square += v * v;
  }
  const vec3 factor(1.0 / glm::sqrt(square / static_cast<double>(kSamples)));
  for (vec4& node : tile) node *= vec4(factor, 0);
}

}  // namespace

std::shared_ptr<const std::vector<vec4>> eddyTile(std::uint64_t seed) {
  static std::mutex mutex;
  static std::map<std::uint64_t, std::weak_ptr<const std::vector<vec4>>> made;
  // The last one stays, so that a scene that is set up anew does not pay again.
  static std::shared_ptr<const std::vector<vec4>> last;
  const std::lock_guard<std::mutex> lock(mutex);
  if (auto known = made[seed].lock()) return last = known;
  auto tile = std::make_shared<std::vector<vec4>>(kTileNodes, vec4(0));
  float amplitude = 1;
  int cell = kLargestCell;
  for (int octave = 0; octave < kTileOctaves; ++octave) {
    addOctave(*tile, seed, octave, cell, amplitude);
    cell /= 2;
    amplitude *= kFalling;
  }
  normalise(*tile);
  std::erase_if(made, [](const auto& entry) { return entry.second.expired(); });
  made[seed] = tile;
  return last = tile;
}

}  // namespace windfall::sim
