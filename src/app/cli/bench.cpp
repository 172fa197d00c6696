#include <sys/resource.h>

#include <QCoreApplication>
#include <QFile>
#include <QFileInfo>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QProcess>
#include <QSaveFile>
#include <QTemporaryDir>
#include <algorithm>
#include <cstdio>

#include "app/cli/commands.h"
#include "app/cli/foliage_bench.h"
#include "app/cli/interrupt.h"
#include "app/cli/plant_bench.h"
#include "model/leaf/quality_bench.h"
#include "model/leaf/texture_bench.h"
#include "sim/bench.h"
#include "widgets/viewport/detail_bench.h"

namespace windfall::app {

namespace {

struct BenchOptions {
  std::string filter, json, photos, method, pictures, firstPicture;
  int rounds = 7, pairs = 6;
};

/// `json` without its last brace, and rows of another kind beside the times.
template <class Row>
std::string withRows(std::string json, const char* name, const std::vector<Row>& rows,
                     std::string (*text)(const Row&)) {
  json.resize(json.rfind('}'));
  while (!json.empty() && json.back() == '\n') json.pop_back();
  json += std::string(",\n  \"") + name + "\": [";
  for (std::size_t i = 0; i < rows.size(); ++i) json += (i ? ",\n    " : "\n    ") + text(rows[i]);
  return json + "\n  ]\n}\n";
}

/// A program of benchmarks that knows other people's programs to compare with; empty where it does not stand beside
/// this one.
QString companion(const QString& name) {
  const QString path = QCoreApplication::applicationDirPath() + QLatin1Char('/') + name;
  return QFileInfo(path).isExecutable() ? path : QString();
}

/// Lets the companion run and print; its results are taken from the file that it writes.
bool runCompanion(const QString& program, const BenchOptions& options, std::vector<sim::BenchmarkResult>& results) {
  const QTemporaryDir folder;
  const QString file = folder.filePath(QStringLiteral("results.json"));
  QProcess process;
  process.setProcessChannelMode(QProcess::ForwardedChannels);
  process.start(program, {QStringLiteral("--filter"), text(options.filter), QStringLiteral("--rounds"),
                          QString::number(options.rounds), QStringLiteral("--json"), file});
  if (!process.waitForFinished(-1) || process.exitStatus() != QProcess::NormalExit || process.exitCode() != 0)
    return false;
  QFile written(file);
  if (!written.open(QIODevice::ReadOnly)) return false;
  const auto string = [](const QJsonObject& object, const char* key) {
    return object[QLatin1String(key)].toString().toStdString();
  };
  for (const QJsonValue& value : QJsonDocument::fromJson(written.readAll())[QLatin1String("benchmarks")].toArray()) {
    const QJsonObject one = value.toObject();
    sim::BenchmarkResult result{
        string(one, "name"), string(one, "what"), string(one, "unit"), one[QLatin1String("rounds")].toInt(), {}};
    for (const QJsonValue& row : one[QLatin1String("contenders")].toArray()) {
      const QJsonObject r = row.toObject();
      result.contenders.push_back({string(r, "name"), r[QLatin1String("least")].toDouble(),
                                   r[QLatin1String("median")].toDouble(), r[QLatin1String("worst")].toDouble(),
                                   string(r, "note")});
    }
    results.push_back(std::move(result));
  }
  return true;
}

void sayLine(const std::string& line) {
  std::printf("%s\n", line.c_str());
  std::fflush(stdout);
}

int bench(const BenchOptions& options) {
  if (!options.firstPicture.empty()) return timeFirstPicture(text(options.firstPicture), options.rounds);
  std::vector<sim::BenchmarkResult> results;
  std::vector<sim::Benchmark> benchmarks;
  const std::pair<const char*, std::vector<sim::Benchmark>> parts[] = {
      {"windfall-bench", sim::simBenchmarks()}, {"windfall-bench-leaf", model::textureBenchmarks()}};
  for (const auto& [name, own] : parts) {
    const QString program = companion(QString::fromLatin1(name));
    const bool wanted = std::any_of(own.begin(), own.end(), [&](const sim::Benchmark& benchmark) {
      return benchmark.name.find(options.filter) != std::string::npos;
    });
    if (program.isEmpty()) {
      benchmarks.insert(benchmarks.end(), own.begin(), own.end());
    } else if (wanted && !runCompanion(program, options, results)) {
      return fail(program, QStringLiteral("did not end well"));
    }
  }
  for (sim::Benchmark& benchmark : plantBenchmarks()) benchmarks.push_back(std::move(benchmark));
  for (const sim::Benchmark& benchmark : benchmarks) {
    if (benchmark.name.find(options.filter) == std::string::npos) continue;
    results.push_back(sim::runBenchmark(benchmark, options.rounds));
    std::printf("%s\n", sim::benchmarkTable(results.back()).c_str());
    std::fflush(stdout);
  }
  if (std::string("plant first picture").find(options.filter) != std::string::npos) {
    Result<sim::BenchmarkResult> pictured = benchFirstPicture(options.rounds);
    if (!pictured) return fail(QString(), pictured.error());
    results.push_back(std::move(*pictured));
    std::printf("%s\n", sim::benchmarkTable(results.back()).c_str());
    std::fflush(stdout);
  }
  // Linux counts kilobytes. What the benchmarks kept for themselves is part of it.
  rusage usage{};
  rusage beside{};
  if (!results.empty() && getrusage(RUSAGE_SELF, &usage) == 0 && getrusage(RUSAGE_CHILDREN, &beside) == 0) {
    std::printf("peak memory: %.0f MB\n\n", static_cast<double>(std::max(usage.ru_maxrss, beside.ru_maxrss)) / 1024);
  }
  const std::string quality = "leaf.quality";
  std::vector<model::QualityRow> rows;
  bool any = !results.empty();
  if (quality.find(options.filter) != std::string::npos) {
    any = true;
    InterruptProgress progress;
    const QString photos = options.photos.empty() ? qEnvironmentVariable("WINDFALL_PHOTOS") : text(options.photos);
    rows = model::benchQuality({photos, options.method, 4, options.pairs, 512}, sayLine, progress);
    if (progress.cancelled()) return fail(QString(), Error{"cancelled", true});
  }
  std::vector<widgets::DetailBenchRow> flight;
  if (std::string("plant.detail").find(options.filter) != std::string::npos) {
    any = true;
    sayLine("plant.detail: a flight through 50 plants, 1280 x 720, wood alone");
    widgets::DetailBenchOptions flightOptions;
    flightOptions.rounds = std::min(options.rounds, flightOptions.rounds);
    flightOptions.pictures = options.pictures;
    Result<std::vector<widgets::DetailBenchRow>> flown = widgets::benchDetail(flightOptions, sayLine);
    if (!flown) return fail(QString(), flown.error());
    flight = std::move(*flown);
  }
  std::vector<FoliageRow> foliage;
  if (std::string("plant.foliage").find(options.filter) != std::string::npos) {
    any = true;
    Result<std::vector<FoliageRow>> drawn = benchFoliage(std::min(options.rounds, 5), options.pictures, sayLine);
    if (!drawn) return fail(QString(), drawn.error());
    foliage = std::move(*drawn);
  }
  if (!any) return fail(QString(), QStringLiteral("no benchmark has a name with \"%1\"").arg(text(options.filter)));
  if (options.json.empty()) return 0;
  QSaveFile file(text(options.json));
  std::string json = withRows(sim::benchmarkJson(results), "quality", rows, model::qualityJson);
  json = withRows(std::move(json), "detail", flight, widgets::detailJson);
  json = withRows(std::move(json), "foliage", foliage, foliageJson);
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
  command->add_option("--photos", options->photos,
                      "Folder of leaf photographs for leaf.quality (default: the environment's WINDFALL_PHOTOS)");
  command->add_option("--method", options->method, "leaf.quality: only methods with this in their name");
  command->add_option("--pairs", options->pairs, "leaf.quality: pairs of photographs besides the two named ones")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  command->add_option("--pictures", options->pictures, "plant.detail, plant.foliage: keep their frames in this folder");
  // How the program asks itself for a project's first picture in a process of its own; of no use to people.
  command->add_option("--first-picture", options->firstPicture)->group("");
  command->add_option("--rounds", options->rounds, "Rounds that each contender runs")->check(CLI::Range(1, 1000));
  command->callback([options, &action] { action = [options] { return bench(*options); }; });
}

}  // namespace windfall::app
