#include "app/run.h"

#include <QCoreApplication>
#include <QGuiApplication>
#include <cstdio>

#include "app/cli/command.h"

namespace windfall::app {

int run(int argc, char** argv) {
  CLI::App cli{"Windfall: leaves, trees and wind for artists"};
  cli.set_version_flag("--version", "windfall " WINDFALL_VERSION);
  Action action;
  declareCommands(cli, action);
  std::string project;
  cli.add_option("PROJECT", project, "Project to open in the editor");
  bool verbose = false;
  cli.add_flag("--verbose", verbose, "Say what is being done on standard error");
  try {
    cli.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return cli.exit(error);
    std::fprintf(stderr, "windfall: %s\n", error.what());
    return 2;
  }
  // Subcommands need pictures and fonts but no display.
  if (action) {
    // What is wrong is one line of ours; Qt's remarks about the machine or a picture's chunks are none.
    if (!verbose) qInstallMessageHandler([](QtMsgType, const QMessageLogContext&, const QString&) {});
    if (qEnvironmentVariableIsEmpty("QT_QPA_PLATFORM")) qputenv("QT_QPA_PLATFORM", "offscreen");
    QGuiApplication application(argc, argv);
    return action();
  }
  return 0;
}

}  // namespace windfall::app
