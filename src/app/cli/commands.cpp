#include "app/cli/commands.h"

#include <cstdio>

namespace windfall::app {

// One line a subcommand: its own file declares it.

namespace {
constexpr DeclareCommand kCommands[] = {
    declareAtlas, declareBench,  declareCheck,    declareLeaf, declareNew,
    declarePlant, declareRender, declareSimulate, declareShot, declareSpecies,
};
}  // namespace

int fail(const QString& file, const QString& message) {
  const QString place = file.isEmpty() ? QString() : file + QStringLiteral(": ");
  std::fprintf(stderr, "windfall: %s%s\n", qUtf8Printable(place), qUtf8Printable(message));
  return 1;
}

int fail(const QString& file, const Error& error) {
  const int status = fail(file, QString::fromStdString(error.message));
  return error.cancelled ? 130 : status;
}

QString text(const std::string& value) { return QString::fromStdString(value); }

void declareCommands(CLI::App& app, Action& action) {
  for (const DeclareCommand declare : kCommands) {
    if (declare) declare(app, action);
  }
}

}  // namespace windfall::app
