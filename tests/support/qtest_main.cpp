// Runs the suites named on the command line, or all: `windfall_model_tests [SUITE] [Qt Test options]`.
#include <QApplication>
#include <QDir>
#include <QFileInfo>
#include <QStandardPaths>
#include <QtTest>

#include "support/suite.h"

namespace windfall::test {

std::map<QString, MakeSuite>& suites() {
  static std::map<QString, MakeSuite> all;
  return all;
}

bool addSuite(const char* file, MakeSuite make) {
  return suites().emplace(QFileInfo(QString::fromUtf8(file)).completeBaseName(), std::move(make)).second;
}

QString sharedData(const QString& relative) {
  const QString path = QDir(QStringLiteral(WINDFALL_SOURCE_DIR)).absoluteFilePath("../shared/data/" + relative);
  return QFileInfo::exists(path) ? QDir::cleanPath(path) : QString();
}

QString outputFolder() {
  const QString folder = QStringLiteral(WINDFALL_TEST_OUTPUT);
  QDir().mkpath(folder);
  return folder;
}

}  // namespace windfall::test

int main(int argc, char** argv) {
  QStandardPaths::setTestModeEnabled(true);
  QApplication application(argc, argv);
  QStringList options = application.arguments();
  QString only;
  if (options.size() > 1 && !options.at(1).startsWith('-')) only = options.takeAt(1);
  int failed = 0, ran = 0;
  for (const auto& [name, make] : windfall::test::suites()) {
    if (!only.isEmpty() && name != only) continue;
    failed += QTest::qExec(make().get(), options);
    ++ran;
  }
  if (ran == 0) {
    qCritical("no suite named %s", qPrintable(only));
    return 1;
  }
  return failed;
}
