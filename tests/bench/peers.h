// Other people's programs for the same jobs.
#pragma once

#include <vector>

#include "sim/bench.h"

/// Bullet's articulated bodies on the tree of the "trees" benchmark; empty where Bullet was not found.
std::vector<windfall::sim::Contender> bulletContenders();
