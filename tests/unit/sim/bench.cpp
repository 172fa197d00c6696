#include "sim/bench.h"

#include <doctest/doctest.h>

#include <memory>

using namespace windfall::sim;

TEST_CASE("contenders run in turns, once more to warm up, and are reported") {
  auto order = std::make_shared<std::string>();
  Benchmark benchmark{"letters", "writes \"letters\"", "ns per letter", 1e9, [order] {
                        return std::vector<Contender>{{"first", [order] { *order += 'a'; }, 2},
                                                      {"second", [order] { *order += 'b'; }, 2}};
                      }};
  const BenchmarkResult result = runBenchmark(benchmark, 3);
  CHECK(*order == "abababab");
  REQUIRE(result.contenders.size() == 2);
  CHECK(result.contenders[0].least <= result.contenders[0].median);
  CHECK(benchmarkTable(result).find("second") != std::string::npos);
  const std::string json = benchmarkJson({result});
  CHECK(json.find("\"what\": \"writes \\\"letters\\\"\"") != std::string::npos);
  CHECK(json.find("\"rounds\": 3") != std::string::npos);
}

TEST_CASE("every benchmark of the simulation has a name and a unit of its own") {
  const std::vector<Benchmark> all = simBenchmarks();
  CHECK(all.size() >= 3);
  for (std::size_t i = 0; i < all.size(); ++i) {
    CHECK_FALSE(all[i].unit.empty());
    for (std::size_t k = 0; k < i; ++k) CHECK(all[i].name != all[k].name);
  }
}
