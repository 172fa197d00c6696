// Other people's programs for the same jobs.
#pragma once

#include <vector>

#include "sim/bench.h"
#include "sim/sample_tree.h"

/// Bullet's articulated bodies on a tree; empty where Bullet was not found.
std::vector<windfall::sim::Contender> bulletContenders(const windfall::sim::SampleTreeSettings& settings);
