// The program as a user runs it.
#pragma once

#include <QByteArray>
#include <QStringList>

namespace windfall::test {

struct ProgramRun {
  int status = -1;
  QByteArray out, error;
};

/// Runs `program` with these arguments and waits; `interruptAfterStart` sends SIGINT once it runs.
ProgramRun runProgram(const QString& program, const QStringList& arguments, bool interruptAfterStart = false);

}  // namespace windfall::test
