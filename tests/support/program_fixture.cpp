#include "support/program_fixture.h"

#include <signal.h>

#include <QFile>
#include <QProcess>
#include <QTest>

namespace windfall::test {

namespace {

/// SIGINT is caught: bit 1 of SigCgt in /proc, so that it is not sent before the program is ready for it.
bool catchesInterrupt(qint64 process) {
  QFile status(QStringLiteral("/proc/%1/status").arg(process));
  if (!status.open(QIODevice::ReadOnly)) return false;
  for (const QByteArray& line : status.readAll().split('\n')) {
    if (line.startsWith("SigCgt:")) return (line.mid(7).trimmed().toULongLong(nullptr, 16) & 2) != 0;
  }
  return false;
}

}  // namespace

ProgramRun runProgram(const QString& program, const QStringList& arguments, bool interruptAfterStart) {
  QProcess process;
  process.start(program, arguments);
  ProgramRun run;
  if (!process.waitForStarted(60'000)) return run;
  if (interruptAfterStart) {
    if (!QTest::qWaitFor([&] { return catchesInterrupt(process.processId()); }, 60'000)) return run;
    ::kill(static_cast<pid_t>(process.processId()), SIGINT);
  }
  if (!process.waitForFinished(300'000)) return run;
  run.status = process.exitStatus() == QProcess::NormalExit ? process.exitCode() : -1;
  run.out = process.readAllStandardOutput();
  run.error = process.readAllStandardError();
  return run;
}

}  // namespace windfall::test
