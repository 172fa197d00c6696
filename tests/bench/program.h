// What the programs of benchmarks beside the editor share: their options, and what they print and write.
#pragma once

#include <string>
#include <vector>

#include "sim/bench.h"

/// Runs the benchmarks that the arguments ask for; the program's exit status. `name` is the program's own.
int runProgram(const std::string& name, const std::vector<windfall::sim::Benchmark>& benchmarks, int count,
               char** arguments);
