// Benchmarks of wind and trees.
#pragma once

#include <vector>

#include "sim/bench.h"

namespace windfall::sim {

std::vector<Benchmark> treeBenchmarks();

}  // namespace windfall::sim
