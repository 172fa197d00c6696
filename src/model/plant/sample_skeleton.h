// Skeletons made by rule, for benchmarks and tests that must not need a file.
#pragma once

#include <cstdint>

#include "model/plant/skeleton_graph.h"

namespace windfall::model {

/// A plant of a shoot with side shoots of several orders.
struct SampleShape {
  float height = 0.9f;    ///< m
  int links = 15;         ///< of the main shoot
  int orders = 2;         ///< of side shoots
  int shoots = 2;         ///< side shoots a link
  float taper = 0.45f;    ///< of a side shoot, share of what bears it
  float radius = 0.006f;  ///< at the base, m
};

/// About 300 segments by default; parents stand first, `attach` and petioles are set. The same for the same seed.
SkeletonGraph sampleSkeleton(std::uint64_t seed, const SampleShape& shape = {});

}  // namespace windfall::model
