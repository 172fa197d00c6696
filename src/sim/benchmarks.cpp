#include "sim/bench.h"
#include "sim/leaf_bench.h"
#include "sim/tree_bench.h"

namespace windfall::sim {

// Every part of the simulation adds its own here.
std::vector<Benchmark> simBenchmarks() {
  std::vector<Benchmark> all;
  for (const auto& part : {treeBenchmarks, leafBenchmarks}) {
    for (Benchmark& benchmark : part()) all.push_back(std::move(benchmark));
  }
  return all;
}

}  // namespace windfall::sim
