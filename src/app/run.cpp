#include "app/run.h"

#include <QCoreApplication>
#include <QFileInfo>
#include <QGuiApplication>
#include <cstdio>

#include "app/cli/command.h"
#include "app/editor.h"

namespace windfall::app {

int run(int argc, char** argv) {
  CLI::App cli{"Windfall: leaves, trees and wind for artists"};
  cli.set_version_flag("--version", "windfall " WINDFALL_VERSION);
  Action action;
  declareCommands(cli, action);
  std::string project;
  cli.add_option("PROJECT", project, "Project to open in the editor");
  EditorOptions editor;
  cli.add_flag("--verbose", editor.verbose, "Say what is being done on standard error");
  // How `windfall shot` starts the window in a process with a display; not for people.
  std::string shotFile, shotWorkspace;
  int shotWidth = 0, shotHeight = 0;
  cli.add_option("--shot-file", shotFile)->group("");
  cli.add_option("--shot-workspace", shotWorkspace)->group("");
  cli.add_option("--shot-width", shotWidth)->group("");
  cli.add_option("--shot-height", shotHeight)->group("");
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
    if (!editor.verbose) qInstallMessageHandler([](QtMsgType, const QMessageLogContext&, const QString&) {});
    if (qEnvironmentVariableIsEmpty("QT_QPA_PLATFORM")) qputenv("QT_QPA_PLATFORM", "offscreen");
    QGuiApplication application(argc, argv);
    return action();
  }
  editor.project = text(project);
  if (!editor.project.isEmpty() && !QFileInfo::exists(editor.project)) {
    return fail(editor.project, QStringLiteral("there is no such project, and no such command (see --help)"));
  }
  // Qt ends the process where it finds no display.
  const bool display = !qEnvironmentVariableIsEmpty("DISPLAY") || !qEnvironmentVariableIsEmpty("WAYLAND_DISPLAY") ||
                       !qEnvironmentVariableIsEmpty("QT_QPA_PLATFORM");
  if (!display) {
    return fail({}, QStringLiteral("the editor needs a display; render and shot make pictures without one"));
  }
  editor.shot = {text(shotFile), text(shotWorkspace), QSize(shotWidth, shotHeight)};
  return runEditor(argc, argv, editor);
}

}  // namespace windfall::app
