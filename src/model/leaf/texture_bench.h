// How long textures take.
#pragma once

#include <vector>

#include "sim/bench.h"

namespace windfall::model {

/// Leaves of 1024 px with the settings that leaf.quality scores: further variants, whole leaves from the photo, and
/// single stages, beside the thesis's own way through them.
std::vector<sim::Benchmark> textureBenchmarks();

}  // namespace windfall::model
