#include <QtTest>

#include "support/suite.h"
#include "widgets/look/language.h"

using namespace windfall;

class LanguageTest : public QObject {
  Q_OBJECT
 private slots:
  void wordsAgreeWithTheirNumber() {
    widgets::installPlurals(*QCoreApplication::instance());
    widgets::installPlurals(*QCoreApplication::instance());
    const auto make = [](int n) { return QCoreApplication::translate("LeafJobs", "Make %n variants", nullptr, n); };
    QCOMPARE(make(1), QStringLiteral("Make a variant"));
    QCOMPARE(make(2), QStringLiteral("Make 2 variants"));
    QCOMPARE(QCoreApplication::translate("RulesEditor", "%n rule(s)", nullptr, 1), QStringLiteral("1 rule"));
    QCOMPARE(QCoreApplication::translate("SceneInspector", "%1, %n rows", nullptr, 1).arg("x"),
             QStringLiteral("x, 1 row"));
  }
};

WINDFALL_SUITE(LanguageTest)
#include "language.moc"
