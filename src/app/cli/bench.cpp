#include <QFile>
#include <QSaveFile>
#include <cstdio>

#include "app/cli/commands.h"
#include "model/leaf/texture_bench.h"
#include "sim/bench.h"

namespace windfall::app {

namespace {

struct BenchOptions {
  std::string filter, json;
  int rounds = 7;
};

int bench(const BenchOptions& options) {
  std::vector<sim::BenchmarkResult> results;
  std::vector<sim::Benchmark> benchmarks = sim::simBenchmarks();
  for (sim::Benchmark& benchmark : model::textureBenchmarks()) benchmarks.push_back(std::move(benchmark));
  for (const sim::Benchmark& benchmark : benchmarks) {
    if (benchmark.name.find(options.filter) == std::string::npos) continue;
    results.push_back(sim::runBenchmark(benchmark, options.rounds));
    std::printf("%s\n", sim::benchmarkTable(results.back()).c_str());
    std::fflush(stdout);
  }
  if (results.empty())
    return fail(QString(), QStringLiteral("no benchmark has a name with \"%1\"").arg(text(options.filter)));
  if (options.json.empty()) return 0;
  QSaveFile file(text(options.json));
  const std::string json = sim::benchmarkJson(results);
  const bool written =
      file.open(QIODevice::WriteOnly) && file.write(json.data(), static_cast<qint64>(json.size())) >= 0;
  return written && file.commit() ? 0 : fail(text(options.json), file.errorString());
}

}  // namespace

void declareBench(CLI::App& app, Action& action) {
  CLI::App* command =
      app.add_subcommand("bench", "Time the simulation and the texture synthesis beside their baselines");
  auto options = std::make_shared<BenchOptions>();
  command->add_option("--filter", options->filter, "Only benchmarks with this in their name");
  command->add_option("--json", options->json, "Write the results to this file too");
  command->add_option("--rounds", options->rounds, "Rounds that each contender runs")->check(CLI::Range(1, 1000));
  command->callback([options, &action] { action = [options] { return bench(*options); }; });
}

}  // namespace windfall::app
