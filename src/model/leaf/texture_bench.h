// How long textures take.
#pragma once

#include <vector>

#include "sim/bench.h"

namespace windfall::model {

/// Textures of 1024 px of a painted leaf: guided beside the classic way of the thesis, and the stages before them.
std::vector<sim::Benchmark> textureBenchmarks();

}  // namespace windfall::model
