// windfall plant --generate: grows a plant without a file.
#pragma once

#include <memory>

#include "app/cli/command.h"

namespace windfall::app {

struct GenerateOptions {
  std::string method, preset, rules, output;
  std::uint64_t seed = 1;
  double age = -1;  ///< years; -1: full-grown
  bool hasAge = false;
};

/// Adds the options to the subcommand.
std::shared_ptr<GenerateOptions> declareGenerate(CLI::App& command);

/// Grows and writes; the exit status.
int generatePlant(const GenerateOptions& options);

}  // namespace windfall::app
