#include "program.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>

int runProgram(const std::string& name, const std::vector<windfall::sim::Benchmark>& benchmarks, int count,
               char** arguments) {
  std::string filter, json;
  int rounds = 7;
  for (int i = 1; i < count; ++i) {
    const auto option = [&](const char* wanted) { return std::strcmp(arguments[i], wanted) == 0 && i + 1 < count; };
    if (option("--filter")) {
      filter = arguments[++i];
    } else if (option("--json")) {
      json = arguments[++i];
    } else if (option("--rounds")) {
      rounds = std::atoi(arguments[++i]);
    } else {
      std::fprintf(stderr, "usage: %s [--filter NAME] [--json FILE] [--rounds N]\n", name.c_str());
      return 2;
    }
  }
  std::vector<windfall::sim::BenchmarkResult> results;
  for (const windfall::sim::Benchmark& benchmark : benchmarks) {
    if (benchmark.name.find(filter) == std::string::npos) continue;
    results.push_back(runBenchmark(benchmark, rounds));
    std::printf("%s\n", benchmarkTable(results.back()).c_str());
    std::fflush(stdout);
  }
  if (json.empty()) return 0;
  std::ofstream file(json, std::ios::binary);
  file << benchmarkJson(results);
  if (file.flush()) return 0;
  std::fprintf(stderr, "%s: %s: cannot be written\n", name.c_str(), json.c_str());
  return 1;
}
