// The subcommands; each is declared in the file of its name.
#pragma once

#include "app/cli/command.h"

namespace windfall::app {

void declareAtlas(CLI::App& app, Action& action);
void declareBench(CLI::App& app, Action& action);
void declareCheck(CLI::App& app, Action& action);
void declareLeaf(CLI::App& app, Action& action);
void declareNew(CLI::App& app, Action& action);
void declarePlant(CLI::App& app, Action& action);
void declareRender(CLI::App& app, Action& action);
void declareSimulate(CLI::App& app, Action& action);
void declareShot(CLI::App& app, Action& action);
void declareSpecies(CLI::App& app, Action& action);

}  // namespace windfall::app
