// The memory behind a LeafField: one block, and what a step needs besides it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "kernels/leaf_arrays.h"
#include "sim/settings.h"

namespace windfall::sim {

struct SceneDescription;

/// Bytes of a block for so many leaves and links, and pointers into one (which may lie on a device).
std::size_t leafBlockBytes(std::uint32_t leaves, std::uint32_t links);
/// Where the state begins in the block; before it lies what does not change but with a leaf's generation.
std::size_t leafStateOffset(std::uint32_t leaves, std::uint32_t links);
LeafArrays leafArraysIn(void* block, std::uint32_t leaves, std::uint32_t links);

/// Scene-wide data of the leaves on the host.
struct LeafStorage {
  std::unique_ptr<std::byte[]> memory;  ///< holds the block at the next 64-byte boundary
  LeafArrays arrays{};
  std::uint32_t links = 0;
  std::shared_ptr<const SceneDescription> scene;  ///< as given
  LeafSettings settings;
  std::uint64_t seed = 1;
  double time = 0;      ///< s, end of the last step
  float dt = 1.f / 60;  ///< s, of the last step
  std::uint32_t stepNumber = 0;
  bool swapped = false;          ///< the arrays' two sides have changed places an odd number of times
  vec3 spawnCentre{0};           ///< m, below which loose leaves start
  std::vector<float> leafShare;  ///< m2 a link: what one of its leaves stands for

  std::byte* block() const;
  /// Spawn height in force: the setting, or 10 m where no tree has a site.
  float spawnHeight = 0;
  /// Decay over the last step of the difference between felt and real wind.
  float feltDecay() const;
  /// The constants of the step that begins at `at`.
  LeafStep stepAt(double at, float length) const;
  /// Lets the new and the previous side of the state change places.
  void swapSides();
};

/// Memory, sites and traits for the leaves of a scene, all at their start.
LeafStorage makeLeafStorage(const SceneDescription& scene);
/// All leaves to where they start.
void resetLeaves(LeafStorage& storage);

}  // namespace windfall::sim
