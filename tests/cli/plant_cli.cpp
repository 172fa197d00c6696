// windfall plant and windfall simulate, as typed by a user.
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTemporaryDir>
#include <QtTest>

#include "support/gltf_fixture.h"
#include "support/program_fixture.h"
#include "support/suite.h"

using namespace windfall;

namespace {

test::ProgramRun windfallRun(const QStringList& arguments, bool interrupt = false) {
  return test::runProgram(QStringLiteral(WINDFALL_PROGRAM), arguments, interrupt);
}

}  // namespace

class PlantCliTest : public QObject {
  Q_OBJECT
 private slots:
  void initTestCase();
  void infoPrintsOneObject();
  void badFilesAndUsageHaveTheirStatus_data();
  void badFilesAndUsageHaveTheirStatus();
  void traceHasARowAStep();
  void theHashDependsOnTheSettingsAndNotOnTheThreads();
  void calmAirBringsTheTreeToRest();
  void interruptedRunsWriteNothing();

 private:
  QString plant() const { return folder_.filePath("plant.glb"); }
  QTemporaryDir folder_;
};

void PlantCliTest::initTestCase() {
  QFile file(plant());
  QVERIFY(file.open(QIODevice::WriteOnly));
  file.write(test::GltfFixture().glb());
  QFile garbage(folder_.filePath("garbage.fbx"));
  QVERIFY(garbage.open(QIODevice::WriteOnly));
  garbage.write("no plant at all");
}

void PlantCliTest::infoPrintsOneObject() {
  const test::ProgramRun run = windfallRun({"plant", plant(), "--info"});
  QCOMPARE(run.status, 0);
  const QJsonObject info = QJsonDocument::fromJson(run.out).object();
  QCOMPARE(info.keys(), (QStringList{"bones", "boundingBox", "buds", "chains", "clips", "depth", "firstFrequency",
                                     "format", "leaves", "mass", "maxInfluences", "nodes", "notes", "plants",
                                     "rigidBodies", "selfBuckling", "stems", "totalStemLength"}));
  QCOMPARE(info["bones"].toInt(), 2);
  QCOMPARE(info["depth"].toInt(), 2);
  QCOMPARE(info["leaves"].toInt(), 1);
  QCOMPARE(info["format"].toString(), QString("glb"));
  QVERIFY(std::abs(info["totalStemLength"].toDouble() - 2) < 1e-5);
  QVERIFY(info["mass"].toDouble() > 100 && info["firstFrequency"].toDouble() > 1);
}

void PlantCliTest::badFilesAndUsageHaveTheirStatus_data() {
  QTest::addColumn<QStringList>("arguments");
  QTest::addColumn<int>("status");
  QTest::addColumn<QString>("says");
  const QString garbage = folder_.filePath("garbage.fbx"), absent = folder_.filePath("absent.fbx");
  QTest::newRow("garbage") << QStringList{"plant", garbage, "--info"} << 1 << garbage + ": cannot be read";
  QTest::newRow("absent") << QStringList{"plant", absent, "--info"} << 1 << absent + ": cannot be opened";
  QTest::newRow("nothing asked") << QStringList{"plant", plant()} << 2 << "--info";
  QTest::newRow("garbage in the wind") << QStringList{"simulate", garbage} << 1 << garbage;
  QTest::newRow("no file") << QStringList{"simulate"} << 2 << "FILE";
  QTest::newRow("vertical wind") << QStringList{"simulate", plant(), "--direction", "0,1,0"} << 2 << "vertical";
  QTest::newRow("half a direction") << QStringList{"simulate", plant(), "--direction", "1,0"} << 2 << "three numbers";
  QTest::newRow("negative time") << QStringList{"simulate", plant(), "--seconds", "-1"} << 2 << "--seconds";
  QTest::newRow("no number") << QStringList{"simulate", plant(), "--wind", "storm"} << 2 << "--wind";
  QTest::newRow("unknown device") << QStringList{"simulate", plant(), "--device", "abacus"} << 2 << "--device";
  QTest::newRow("unknown method") << QStringList{"simulate", plant(), "--method", "guess"} << 2 << "--method";
  QTest::newRow("no folder for the trace")
      << QStringList{"simulate", plant(), "--trace", folder_.filePath("none/t.csv")} << 1 << "none/t.csv";
}

void PlantCliTest::badFilesAndUsageHaveTheirStatus() {
  QFETCH(QStringList, arguments);
  QFETCH(int, status);
  QFETCH(QString, says);
  const test::ProgramRun run = windfallRun(arguments);
  QCOMPARE(run.status, status);
  QVERIFY2(run.error.contains(says.toUtf8()), run.error.constData());
  QVERIFY(run.error.contains("windfall: "));
  QVERIFY(run.out.isEmpty());
}

void PlantCliTest::traceHasARowAStep() {
  const QString path = folder_.filePath("trace.csv");
  const test::ProgramRun run = windfallRun({"simulate", plant(), "--seconds", "2", "--dt", "0.02", "--wind", "8",
                                            "--direction", "-1,0,-1", "--trace", path});
  QVERIFY2(run.status == 0, run.error.constData());
  QFile file(path);
  QVERIFY(file.open(QIODevice::ReadOnly));
  const QList<QByteArray> rows = file.readAll().trimmed().split('\n');
  QCOMPARE(rows.size(), 102);
  QVERIFY(rows[0].startsWith("time_s,tip_displacement_m,largest_angle_deg,"));
  QCOMPARE(rows[101].split(',').size(), 8);
  QVERIFY(std::abs(rows[101].split(',')[0].toDouble() - 2) < 1e-6);
  QVERIFY(run.out.trimmed().split('\n').last().contains("first frequency"));
}

void PlantCliTest::theHashDependsOnTheSettingsAndNotOnTheThreads() {
  const auto hash = [&](const QStringList& more) {
    const test::ProgramRun run =
        windfallRun(QStringList{"simulate", plant(), "--seconds", "1", "--hash", "--device", "cpu"} + more);
    return run.out.trimmed().split('\n').last();
  };
  const QByteArray one = hash({"--threads", "1"});
  QVERIFY2(one.startsWith("state ") && one.size() == 22, one.constData());
  QCOMPARE(hash({"--threads", "2"}), one);
  QVERIFY(hash({"--wind", "9"}) != one);
  QByteArrayList ofMethods;
  for (const char* method : {"coupled", "analytic", "forces", "literal"}) {
    const QByteArray first = hash({"--method", method, "--threads", "1"});
    QVERIFY(first.startsWith("state "));
    QCOMPARE(hash({"--method", method, "--threads", "2"}), first);
    QVERIFY2(!ofMethods.contains(first), method);
    ofMethods.append(first);
  }
}

void PlantCliTest::calmAirBringsTheTreeToRest() {
  const QString path = folder_.filePath("calm.csv");
  const test::ProgramRun run =
      windfallRun({"simulate", plant(), "--seconds", "20", "--wind", "15", "--wind-until", "3", "--trace", path});
  QCOMPARE(run.status, 0);
  QFile file(path);
  QVERIFY(file.open(QIODevice::ReadOnly));
  double peak = 0, last = 0;
  for (const QByteArray& row : file.readAll().trimmed().split('\n').mid(1)) {
    last = row.split(',')[3].toDouble() + row.split(',')[4].toDouble();
    peak = std::max(peak, last);
  }
  QVERIFY(peak > 0 && last < 0.01 * peak);
}

void PlantCliTest::interruptedRunsWriteNothing() {
  const QString path = folder_.filePath("interrupted.csv");
  const test::ProgramRun run = windfallRun({"simulate", plant(), "--seconds", "1e6", "--trace", path}, true);
  QCOMPARE(run.status, 130);
  QVERIFY(!QFile::exists(path));
}

WINDFALL_SUITE(PlantCliTest)
#include "plant_cli.moc"
