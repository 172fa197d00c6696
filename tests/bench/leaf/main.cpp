// windfall-bench-leaf: the benchmarks of leaf textures beside other people's programs.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>

#include "sim/bench.h"
#include "ximgproc.h"

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
      std::fprintf(stderr, "usage: windfall-bench-leaf [--filter NAME] [--json FILE] [--rounds N]\n");
      return 2;
    }
  }
  std::vector<windfall::sim::BenchmarkResult> results;
  for (const windfall::sim::Benchmark& benchmark : windfall::model::textureBenchmarks({openCvSlic()})) {
    if (benchmark.name.find(filter) == std::string::npos) continue;
    results.push_back(runBenchmark(benchmark, rounds));
    std::printf("%s\n", benchmarkTable(results.back()).c_str());
    std::fflush(stdout);
  }
  if (json.empty()) return 0;
  std::ofstream file(json, std::ios::binary);
  file << benchmarkJson(results);
  if (file.flush()) return 0;
  std::fprintf(stderr, "windfall-bench-leaf: %s: cannot be written\n", json.c_str());
  return 1;
}
