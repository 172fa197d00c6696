// Benchmarks of grown plants: growth, meshing, from a file to the first picture.
#pragma once

#include <vector>

#include "sim/bench.h"

namespace windfall::app {

/// "plant": growth by each grower, dressing, and a tree of 50,000 organs from its file to its first picture; the
/// latter's name tells the memory that the process took at its highest.
std::vector<sim::Benchmark> plantBenchmarks();

}  // namespace windfall::app
