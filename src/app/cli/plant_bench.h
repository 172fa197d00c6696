// Benchmarks of grown plants: growth, meshing, from a file to the first picture.
#pragma once

#include <QString>
#include <vector>

#include "sim/bench.h"
#include "sim/result.h"

namespace windfall::app {

/// "plant": growth by each grower, and dressing.
std::vector<sim::Benchmark> plantBenchmarks();

/// A tree of 50,000 organs from its file to its first picture, with adaptive wood and with whole meshes, each in a
/// process of its own; the notes tell the processor's time and the most memory that the first picture took.
Result<sim::BenchmarkResult> benchFirstPicture(int rounds);
/// That process: prints MB, then a line of wall and processor's ms for each round.
int timeFirstPicture(const QString& file, int rounds);

}  // namespace windfall::app
