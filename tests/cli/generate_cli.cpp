// windfall plant --generate, as typed by a user: what it writes, and what it says when something is wrong.
#include <QFile>
#include <QTemporaryDir>
#include <QtTest>

#include "model/document/project_file.h"
#include "model/plant/prim_format.h"
#include "support/program_fixture.h"
#include "support/suite.h"

using namespace windfall;

class GenerateCliTest : public QObject {
  Q_OBJECT

  test::ProgramRun generate(const QStringList& arguments) {
    return test::runProgram(QStringLiteral(WINDFALL_PROGRAM), QStringList{"plant", "--generate"} + arguments);
  }
  QString write(const char* name, const QByteArray& text) {
    QFile file(folder_.filePath(name));
    if (file.open(QIODevice::WriteOnly)) file.write(text);
    return file.fileName();
  }
  QTemporaryDir folder_;

 private slots:
  void everyMethodWritesAPlant() {
    const QString prim = folder_.filePath("fir.prim");
    const test::ProgramRun run = generate({"l-system", "--preset", "fir", "--age", "20", "--seed", "3", "-o", prim});
    QVERIFY2(run.status == 0, run.error);
    QFile file(prim);
    QVERIFY(file.open(QIODevice::ReadOnly));
    const Result<model::PrimFile> read = model::readPrim(file.readAll());
    QVERIFY(read && read->graph.segments.size() > 100);

    const QString project = folder_.filePath("pine.windfall");
    QCOMPARE(generate({"self-organizing", "--preset", "Pine", "-o", project}).status, 0);
    model::Progress progress;
    const Result<model::Project> opened = model::readProject(project, progress);
    QVERIFY(opened && opened->plants.size() == 1 &&
            opened->plants[0].grower->method == model::GrowMethod::SelfOrganizing);

    const QString mesh = folder_.filePath("dead.obj");
    QCOMPARE(generate({"space-colonization", "--preset", "dead tree", "-o", mesh}).status, 0);
    QVERIFY(QFile::exists(mesh));
  }

  void theSameSeedGivesTheSameBytes() {
    QByteArray bytes[3];
    for (int i = 0; i < 3; ++i) {
      const QString path = folder_.filePath(QStringLiteral("aspen%1.prim").arg(i));
      QCOMPARE(generate({"space-colonization", "--preset", "aspen", "--seed", i < 2 ? "5" : "6", "-o", path}).status,
               0);
      QFile file(path);
      QVERIFY(file.open(QIODevice::ReadOnly));
      bytes[i] = file.readAll();
    }
    QCOMPARE(bytes[0], bytes[1]);
    QVERIFY(bytes[0] != bytes[2]);
  }

  void whatIsWrongIsOneLine_data() {
    QTest::addColumn<QStringList>("arguments");
    QTest::addColumn<int>("status");
    QTest::addColumn<QByteArray>("message");
    const QString out = folder_.filePath("never.obj");
    QTest::addRow("rules") << QStringList{"l-system", "--rules", write("a.l", "axiom: A\nA -> F+(30"), "-o", out} << 1
                           << QByteArray("a.l: rules 2:8: '(' is never closed");
    QTest::addRow("explode") << QStringList{"l-system", "--rules",
                                            write("b.l", "#iterations 30\naxiom: F\nF -> FFFFFFFFFF"), "-o", out}
                             << 1 << QByteArray("b.l: rules: the rules make more than 200000 links");
    QTest::addRow("explode in modules")
        << QStringList{"l-system", "--rules", write("c.l", "#iterations 1000\naxiom: FA\nA -> AAAA"), "-o", out} << 1
        << QByteArray("c.l: generation 11 would make 4,194,305 modules (limit 2,000,000); showing generation 10");
    QTest::addRow("age") << QStringList{"space-colonization", "--age", "-3", "-o", out} << 1
                         << QByteArray("the age must be 0 to 10,000 years");
    QTest::addRow("nan") << QStringList{"space-colonization", "--age", "nan", "-o", out} << 1
                         << QByteArray("the age must be 0 to 10,000 years");
    QTest::addRow("preset") << QStringList{"space-colonization", "--preset", "baobab", "-o", out} << 1
                            << QByteArray("there is no preset \"baobab\"");
    QTest::addRow("method") << QStringList{"magic", "-o", out} << 2 << QByteArray("--generate");
    QTest::addRow("output") << QStringList{"space-colonization"} << 2 << QByteArray("--output");
    QTest::addRow("kind") << QStringList{"l-system", "--preset", "herb", "-o", folder_.filePath("plant.xyz")} << 1
                          << QByteArray("is no kind of file");
  }

  void whatIsWrongIsOneLine() {
    QFETCH(QStringList, arguments);
    QFETCH(int, status);
    QFETCH(QByteArray, message);
    const test::ProgramRun run = generate(arguments);
    QCOMPARE(run.status, status);
    QVERIFY2(run.error.contains(message), run.error);
    QVERIFY(run.error.startsWith("windfall: "));
    QCOMPARE(run.error.trimmed().count('\n'), 0);
    QVERIFY(!QFile::exists(folder_.filePath("never.obj")));
  }
};

WINDFALL_SUITE(GenerateCliTest)
#include "generate_cli.moc"
