// windfall-bench: the benchmarks of the simulation without the editor.
#include <utility>

#include "peers.h"
#include "program.h"

int main(int count, char** arguments) {
  std::vector<windfall::sim::Benchmark> benchmarks = windfall::sim::simBenchmarks();
  for (windfall::sim::Benchmark& benchmark : benchmarks) {
    for (const auto& [name, links] : {std::pair{"tree-1k", 1'000}, std::pair{"tree-10k", 10'000}}) {
      if (benchmark.name != name) continue;
      benchmark.prepare = [ours = benchmark.prepare, links = links] {
        std::vector<windfall::sim::Contender> all = ours();
        const auto tree = windfall::sim::broadleafOf(static_cast<std::size_t>(links));
        for (windfall::sim::Contender& peer : bulletContenders(tree)) all.push_back(std::move(peer));
        return all;
      };
    }
  }
  return runProgram("windfall-bench", benchmarks, count, arguments);
}
