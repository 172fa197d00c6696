// Benchmarks of falling leaves.
#pragma once

#include <vector>

#include "sim/bench.h"

namespace windfall::sim {

/// A step of leaves that all fall, beside the published kernel with its mistakes mended (falling_leaves.md, 8.5 a).
std::vector<Benchmark> leafBenchmarks();

}  // namespace windfall::sim
