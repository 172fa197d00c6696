// The command line: one subcommand is one file of this folder and one line in commands.cpp.
#pragma once

#include <CLI/CLI.hpp>
#include <QString>
#include <functional>

#include "sim/result.h"

namespace windfall::app {

/// What the chosen subcommand will do once everything is parsed; returns the process's exit status.
using Action = std::function<int()>;

/// Declares a subcommand and sets `action` when it was given.
using DeclareCommand = void (*)(CLI::App& app, Action& action);

/// Says "windfall: FILE: what is wrong" on standard error; 1, or 130 when it was cancelled.
int fail(const QString& file, const Error& error);
int fail(const QString& file, const QString& message);

/// "CLI11 value" to QString, as UTF-8.
QString text(const std::string& value);

void declareCommands(CLI::App& app, Action& action);

}  // namespace windfall::app
