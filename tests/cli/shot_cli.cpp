// windfall shot, as typed by a user on a machine without a display.
#include <QFile>
#include <QImage>
#include <QStandardPaths>
#include <QTemporaryDir>
#include <QtTest>

#include "model/document/document.h"
#include "support/painted_leaf.h"
#include "support/program_fixture.h"
#include "support/suite.h"

using namespace windfall;

class ShotCliTest : public QObject {
  Q_OBJECT
 private slots:
  void initTestCase() {
    model::Document document;
    document.addLeaf(test::paintedLeaf());
    model::Progress progress;
    QVERIFY(document.save(project(), progress));
    QFile garbage(folder_.filePath("garbage.windfall"));
    QVERIFY(garbage.open(QIODevice::WriteOnly));
    garbage.write("no project at all");
    // The program must make its own display.
    qunsetenv("DISPLAY");
  }

  void theRealWindowIsPictured() {
    if (QStandardPaths::findExecutable("Xvfb").isEmpty() || QStandardPaths::findExecutable("openbox").isEmpty()) {
      QSKIP("Xvfb or openbox is not installed");
    }
    const QString file = folder_.filePath("shot.png");
    const test::ProgramRun run = test::runProgram(
        QStringLiteral(WINDFALL_PROGRAM), {"shot", project(), "--workspace", "leaf", "--size", "1100x760", "-o", file});
    QCOMPARE(run.status, 0);
    const QImage picture(file);
    QCOMPARE(picture.size(), QSize(1100, 760));
    // The painted leaf stands in the middle of the canvas.
    bool green = false;
    for (int x = 200; x < 700 && !green; ++x) {
      const QColor color = picture.pixelColor(x, 330);
      green = color.green() > 110 && color.green() > color.blue() + 50 && color.red() < 130;
    }
    QVERIFY(green);
  }

  void mistakesHaveTheirStatusAndWriteNothing_data() {
    QTest::addColumn<QStringList>("arguments");
    QTest::addColumn<int>("status");
    QTest::newRow("no such project") << QStringList{"nowhere.windfall"} << 1;
    QTest::newRow("damaged project") << QStringList{folder_.filePath("garbage.windfall")} << 1;
    QTest::newRow("bad size") << QStringList{project(), "--size", "wide"} << 2;
    QTest::newRow("unknown workspace") << QStringList{project(), "--workspace", "kitchen"} << 2;
  }
  void mistakesHaveTheirStatusAndWriteNothing() {
    QFETCH(QStringList, arguments);
    QFETCH(int, status);
    const QString file = folder_.filePath("never.png");
    const test::ProgramRun run =
        test::runProgram(QStringLiteral(WINDFALL_PROGRAM), QStringList{"shot", "-o", file} + arguments);
    QCOMPARE(run.status, status);
    QVERIFY(!QFile::exists(file));
  }

 private:
  QString project() const { return folder_.filePath("leaf.windfall"); }
  QTemporaryDir folder_;
};

WINDFALL_SUITE(ShotCliTest)
#include "shot_cli.moc"
