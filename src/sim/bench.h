// Benchmarks that compare: contenders for one job run in turns in the same process, so that a busy machine slows all
// alike.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace windfall::sim {

/// One way to do the job.
struct Contender {
  std::string name;           ///< "coupled, 2 threads"
  std::function<void()> run;  ///< does the job once
  double items = 1;           ///< what one run does: links times steps, leaves, textures
  int repeats = 1;            ///< runs a round, each timed by itself: short ones slip between a busy machine's others
  std::string note;           ///< what else is worth saying: "522 bytes a link"
  /// In the place of `run`: does the job from its start to its end, in equal steps each time, and tells how long each
  /// step took, s. Of a step the least of all rounds counts, so that what is left is the program's own unevenness.
  std::function<std::vector<double>()> profile = nullptr;
};

/// A job and those who do it; the first contender is ours, the others are what it is measured against.
struct Benchmark {
  std::string name;                                 ///< "trees"
  std::string what;                                 ///< one line for the user
  std::string unit;                                 ///< of one item: "ns per link and step"
  double unitsPerSecond = 1e9;                      ///< 1e9: ns, 1e3: ms, 1: s
  std::function<std::vector<Contender>()> prepare;  ///< builds the inputs; called only when the benchmark runs
};

struct ContenderResult {
  std::string name;
  double least = 0, median = 0;  ///< in the benchmark's unit
  double worst = 0;              ///< the longest of a profile's steps; 0 without
  std::string note;
};

struct BenchmarkResult {
  std::string name, what, unit;
  int rounds = 0;
  std::vector<ContenderResult> contenders;
};

/// Runs every contender once to warm up, then `rounds` times, in turns.
BenchmarkResult runBenchmark(const Benchmark& benchmark, int rounds);

/// A table for people: least and median, and how many times the first contender's least each one takes.
std::string benchmarkTable(const BenchmarkResult& result);
/// One JSON object with all results.
std::string benchmarkJson(const std::vector<BenchmarkResult>& results);

/// The benchmarks of the simulation.
std::vector<Benchmark> simBenchmarks();

}  // namespace windfall::sim
