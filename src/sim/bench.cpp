#include "sim/bench.h"

#include <algorithm>
#include <chrono>
#include <cstdio>

namespace windfall::sim {

namespace {

std::string number(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string padded(std::string text, std::size_t width) {
  text.resize(std::max(width, text.size()), ' ');
  return text;
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return out + '"';
}

}  // namespace

namespace {
/// The least of each step so far.
void join(std::vector<double>& least, const std::vector<double>& round, double units) {
  if (least.empty()) least.assign(round.size(), 1e30);
  for (std::size_t i = 0; i < least.size(); ++i) least[i] = std::min(least[i], round[i] * units);
}
}  // namespace

BenchmarkResult runBenchmark(const Benchmark& benchmark, int rounds) {
  BenchmarkResult result{benchmark.name, benchmark.what, benchmark.unit, std::max(rounds, 1), {}};
  const std::vector<Contender> contenders = benchmark.prepare();
  std::vector<std::vector<double>> times(contenders.size());
  for (const Contender& contender : contenders) {
    if (contender.run) contender.run();
  }
  for (int round = 0; round < result.rounds; ++round) {
    for (std::size_t c = 0; c < contenders.size(); ++c) {
      if (contenders[c].profile) {
        join(times[c], contenders[c].profile(), benchmark.unitsPerSecond / contenders[c].items);
        continue;
      }
      for (int repeat = 0; repeat < contenders[c].repeats; ++repeat) {
        const auto start = std::chrono::steady_clock::now();
        contenders[c].run();
        const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
        times[c].push_back(taken.count() * benchmark.unitsPerSecond / contenders[c].items);
      }
    }
  }
  for (std::size_t c = 0; c < contenders.size(); ++c) {
    std::sort(times[c].begin(), times[c].end());
    result.contenders.push_back({contenders[c].name, times[c].front(), times[c][times[c].size() / 2],
                                 contenders[c].profile ? times[c].back() : 0, contenders[c].note});
  }
  return result;
}

std::string benchmarkTable(const BenchmarkResult& result) {
  std::string table =
      result.name + ": " + result.what + " (" + result.unit + ", " + std::to_string(result.rounds) + " rounds)\n";
  std::size_t width = 0;
  for (const ContenderResult& row : result.contenders) width = std::max(width, row.name.size());
  for (const ContenderResult& row : result.contenders) {
    const double times = row.least / result.contenders.front().least;
    table += "  " + padded(row.name, width) + number("  least %9.3g", row.least) +
             number("  median %9.3g", row.median) + (row.worst > 0 ? number("  worst %9.3g", row.worst) : "") +
             number("  %6.2fx", times) + (row.note.empty() ? "" : "  " + row.note) + "\n";
  }
  return table;
}

std::string benchmarkJson(const std::vector<BenchmarkResult>& results) {
  std::string json = "{\n  \"benchmarks\": [";
  for (std::size_t b = 0; b < results.size(); ++b) {
    const BenchmarkResult& result = results[b];
    json += std::string(b ? "," : "") + "\n    {\"name\": " + quoted(result.name) +
            ", \"what\": " + quoted(result.what) + ", \"unit\": " + quoted(result.unit) +
            ", \"rounds\": " + std::to_string(result.rounds) + ", \"contenders\": [";
    for (std::size_t c = 0; c < result.contenders.size(); ++c) {
      const ContenderResult& row = result.contenders[c];
      json += std::string(c ? "," : "") + "\n      {\"name\": " + quoted(row.name) +
              ", \"least\": " + number("%.6g", row.least) + ", \"median\": " + number("%.6g", row.median) +
              (row.worst > 0 ? ", \"worst\": " + number("%.6g", row.worst) : "") +
              (row.note.empty() ? "" : ", \"note\": " + quoted(row.note)) + "}";
    }
    json += "\n    ]}";
  }
  return json + "\n  ]\n}\n";
}

}  // namespace windfall::sim
