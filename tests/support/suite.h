// Several Qt Test classes in one binary: each file registers its class and is run by the file's name.
#pragma once

#include <QObject>
#include <QString>
#include <functional>
#include <map>
#include <memory>

namespace windfall::test {

using MakeSuite = std::function<std::unique_ptr<QObject>()>;

/// Suites by the stem of their file's name.
std::map<QString, MakeSuite>& suites();
bool addSuite(const char* file, MakeSuite make);

/// A file of the shared test data, or an empty string where that folder is absent (then skip by name).
QString sharedData(const QString& relative);
/// A folder for actual and expected pictures of failed comparisons.
QString outputFolder();

}  // namespace windfall::test

/// At the end of a test file, before its .moc is included.
#define WINDFALL_SUITE(Class)                            \
  [[maybe_unused]] static const bool registered##Class = \
      windfall::test::addSuite(__FILE__, [] { return std::unique_ptr<QObject>(new Class); });
