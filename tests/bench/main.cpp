// windfall-bench: the benchmarks of the simulation without the editor.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>
#include <utility>

#include "peers.h"
#include "sim/bench.h"

int main(int count, char** arguments) {
  std::string filter, json;
  int rounds = 7;
  for (int i = 1; i < count; ++i) {
    const auto option = [&](const char* name) { return std::strcmp(arguments[i], name) == 0 && i + 1 < count; };
    if (option("--filter")) {
      filter = arguments[++i];
    } else if (option("--json")) {
      json = arguments[++i];
    } else if (option("--rounds")) {
      rounds = std::atoi(arguments[++i]);
    } else {
      std::fprintf(stderr, "usage: windfall-bench [--filter NAME] [--json FILE] [--rounds N]\n");
      return 2;
    }
  }
  std::vector<windfall::sim::BenchmarkResult> results;
  for (windfall::sim::Benchmark& benchmark : windfall::sim::simBenchmarks()) {
    if (benchmark.name.find(filter) == std::string::npos) continue;
    for (const auto& [name, links] : {std::pair{"tree-1k", 1'000}, std::pair{"tree-10k", 10'000}}) {
      if (benchmark.name != name) continue;
      benchmark.prepare = [ours = benchmark.prepare, links = links] {
        std::vector<windfall::sim::Contender> all = ours();
        const auto tree = windfall::sim::broadleafOf(static_cast<std::size_t>(links));
        for (windfall::sim::Contender& peer : bulletContenders(tree)) all.push_back(std::move(peer));
        return all;
      };
    }
    results.push_back(runBenchmark(benchmark, rounds));
    std::printf("%s\n", benchmarkTable(results.back()).c_str());
    std::fflush(stdout);
  }
  if (json.empty()) return 0;
  std::ofstream file(json, std::ios::binary);
  file << benchmarkJson(results);
  if (file.flush()) return 0;
  std::fprintf(stderr, "windfall-bench: %s: cannot be written\n", json.c_str());
  return 1;
}
