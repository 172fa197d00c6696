// windfall shot: a picture of the real window.
#include <QCoreApplication>
#include <QElapsedTimer>
#include <QFile>
#include <QFileInfo>
#include <QProcess>
#include <QRegularExpression>
#include <QSize>
#include <QStandardPaths>
#include <QTemporaryDir>

#include "app/cli/commands.h"

namespace windfall::app {

namespace {

struct Options {
  std::string project, workspace = "scene", size = "1600x1000", output;
  bool light = false;
};

/// Ends the program when it goes out of scope.
struct Child {
  QProcess process;
  ~Child() {
    if (process.state() == QProcess::NotRunning) return;
    process.terminate();
    if (!process.waitForFinished(3000)) process.kill();
    process.waitForFinished(3000);
  }
};

/// A virtual display with a window manager: without one no window gets the focus.
class Display {
 public:
  /// ":N", or what is missing.
  Result<QString> start(QSize screen) {
    for (const char* program : {"Xvfb", "openbox"}) {
      if (QStandardPaths::findExecutable(QString::fromLatin1(program)).isEmpty()) {
        return Error{std::string("there is no display, and ") + program + " is not installed to make one"};
      }
    }
    server_.process.setProcessChannelMode(QProcess::SeparateChannels);
    server_.process.start(QStringLiteral("Xvfb"),
                          {QStringLiteral("-displayfd"), QStringLiteral("1"), QStringLiteral("-screen"),
                           QStringLiteral("0"), QStringLiteral("%1x%2x24").arg(screen.width()).arg(screen.height()),
                           QStringLiteral("-nolisten"), QStringLiteral("tcp")});
    QByteArray number;
    QElapsedTimer clock;
    clock.start();
    while (!number.endsWith('\n') && clock.elapsed() < 15000 && server_.process.state() != QProcess::NotRunning) {
      server_.process.waitForReadyRead(200);
      number += server_.process.readAllStandardOutput();
    }
    if (!number.endsWith('\n')) return Error{"Xvfb did not start"};
    const QString display = QLatin1Char(':') + QString::fromLatin1(number.trimmed());
    QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
    environment.insert(QStringLiteral("DISPLAY"), display);
    manager_.process.setProcessEnvironment(environment);
    manager_.process.setStandardErrorFile(QProcess::nullDevice());
    manager_.process.setStandardOutputFile(QProcess::nullDevice());
    manager_.process.start(QStringLiteral("openbox"), QStringList());
    if (!manager_.process.waitForStarted(5000)) return Error{"openbox did not start"};
    return display;
  }

 private:
  Child server_, manager_;  // the manager ends before its server
};

int run(const Options& options) {
  static const QRegularExpression sizes(QStringLiteral("^(\\d{2,5})x(\\d{2,5})$"));
  const QRegularExpressionMatch match = sizes.match(text(options.size));
  if (!match.hasMatch()) {
    std::fprintf(stderr, "windfall: --size: %s is not WIDTHxHEIGHT\n", options.size.c_str());
    return 2;
  }
  const QString project = text(options.project);
  if (!QFileInfo(project).isFile()) return fail(project, QStringLiteral("no such file"));
  const QSize size(match.captured(1).toInt(), match.captured(2).toInt());

  QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
  Display display;
  QTemporaryDir runtime;
  if (!environment.contains(QStringLiteral("DISPLAY"))) {
    // Room for the window manager's frame.
    const Result<QString> name = display.start(size + QSize(80, 120));
    if (!name) return fail({}, name.error());
    environment.insert(QStringLiteral("DISPLAY"), *name);
  }
  if (!environment.contains(QStringLiteral("XDG_RUNTIME_DIR"))) {
    QFile::setPermissions(runtime.path(), QFile::ReadOwner | QFile::WriteOwner | QFile::ExeOwner);
    environment.insert(QStringLiteral("XDG_RUNTIME_DIR"), runtime.path());
  }
  environment.insert(QStringLiteral("QT_QPA_PLATFORM"), QStringLiteral("xcb"));
  if (options.light) environment.insert(QStringLiteral("WINDFALL_LOOK"), QStringLiteral("light"));
  // The window lives in a process of its own: this one has no display.
  Child editor;
  editor.process.setProcessEnvironment(environment);
  editor.process.setProcessChannelMode(QProcess::ForwardedChannels);
  editor.process.start(
      QCoreApplication::applicationFilePath(),
      {project, QStringLiteral("--shot-file"), QFileInfo(text(options.output)).absoluteFilePath(),
       QStringLiteral("--shot-workspace"), text(options.workspace), QStringLiteral("--shot-width"),
       QString::number(size.width()), QStringLiteral("--shot-height"), QString::number(size.height())});
  if (!editor.process.waitForFinished(180000)) return fail(project, QStringLiteral("the window did not answer"));
  if (editor.process.exitStatus() != QProcess::NormalExit) {
    return fail(project, QStringLiteral("the editor crashed while its window was shown"));
  }
  return editor.process.exitCode();
}

}  // namespace

void declareShot(CLI::App& app, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("shot", "Take a picture of the editor's window");
  command->add_option("PROJECT", options->project, "Project to show")->required();
  command->add_option("--workspace", options->workspace, "leaf, plant or scene")
      ->check(CLI::IsMember({"leaf", "plant", "scene"}));
  command->add_option("--size", options->size, "Size of the window, WIDTHxHEIGHT");
  command->add_flag("--light", options->light, "The light palette instead of the dark one");
  command->add_option("-o,--output", options->output, "PNG to write")->required();
  command->callback([options, &action] { action = [options] { return run(*options); }; });
}

}  // namespace windfall::app
