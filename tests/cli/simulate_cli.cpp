// windfall simulate, as typed by a user: recorded wind, every form of the solver, baked clips.
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

class SimulateCliTest : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;

  QString plant() const { return folder_.filePath("plant.glb"); }
  QString write(const QString& name, const QByteArray& bytes) {
    QFile file(folder_.filePath(name));
    if (file.open(QIODevice::WriteOnly)) file.write(bytes);
    return file.fileName();
  }
  static test::ProgramRun run(const QStringList& arguments) {
    return test::runProgram(QStringLiteral(WINDFALL_PROGRAM), QStringList{"simulate"} + arguments);
  }
  static QByteArray hash(const QStringList& arguments) {
    return run(arguments + QStringList{"--seconds", "2", "--hash", "--device", "cpu"}).out.trimmed().split('\n').last();
  }

 private slots:
  void initTestCase() { write("plant.glb", test::GltfFixture().glb()); }

  void recordedWindDrivesTheTree() {
    const QString csv = write("mast.csv", "time,speed,direction\n0,3,270\n1,14,280\n2,4,250\n");
    const QByteArray recorded = hash({plant(), "--wind-data", csv});
    QVERIFY2(recorded.startsWith("state "), recorded.constData());
    QCOMPARE(hash({plant(), "--wind-data", csv}), recorded);
    QVERIFY(hash({plant()}) != recorded);
    // A calm record moves nothing, whatever the plant's own wind is.
    const QString calm = write("calm.csv", "0,0,270\n10,0,270\n");
    const test::ProgramRun still = run({plant(), "--wind-data", calm, "--seconds", "3"});
    QVERIFY2(still.out.contains("mean tip displacement 0 m"), still.out.constData());
  }

  void aDamagedRecordIsNamedWithFileAndLine() {
    const QString csv = write("bad.csv", "time,speed,direction\n0,3,270\n1,storm,280\n");
    const test::ProgramRun refused = run({plant(), "--wind-data", csv});
    QCOMPARE(refused.status, 1);
    QCOMPARE(refused.error.trimmed(), ("windfall: " + csv + ": line 3: the speed \"storm\" is not a number").toUtf8());
    const test::ProgramRun absent = run({plant(), "--wind-data", folder_.filePath("none.csv")});
    QCOMPARE(absent.status, 1);
    QCOMPARE(absent.error.trimmed().count('\n'), 0);
  }

  void everyMethodRunsByName() {
    for (const char* method : {"coupled", "analytic", "forces", "literal"}) {
      const test::ProgramRun done = run({plant(), "--method", method, "--seconds", "1", "--wind", "8"});
      QVERIFY2(done.status == 0, done.error.constData());
      QVERIFY2(done.out.contains("first frequency") && !done.out.contains("displacement 0 m"), done.out.constData());
    }
  }

  void aLoopableClipIsBakedIntoAGltf() {
    const QString baked = folder_.filePath("baked.glb");
    const test::ProgramRun done = run({plant(), "--bake", baked, "--bake-seconds", "2", "--wind", "9"});
    QVERIFY2(done.status == 0, done.error.constData());
    QVERIFY2(done.out.startsWith("Wind 9.0 m/s: 2 s, 2 bones"), done.out.constData());
    const test::ProgramRun info = test::runProgram(QStringLiteral(WINDFALL_PROGRAM), {"plant", baked, "--info"});
    QVERIFY2(info.status == 0, info.error.constData());
    const QJsonObject told = QJsonDocument::fromJson(info.out).object();
    QCOMPARE(told["clips"].toArray(), (QJsonArray{"Wind 9.0 m/s"}));

    // First and last key of every channel are equal.
    QFile file(baked);
    QVERIFY(file.open(QIODevice::ReadOnly));
    const QByteArray bytes = file.readAll();
    const auto word = [&](qsizetype at) { return qFromLittleEndian<quint32>(bytes.constData() + at); };
    const QJsonObject root = QJsonDocument::fromJson(bytes.mid(20, word(12))).object();
    const QByteArray data = bytes.mid(20 + word(12) + 8);
    const auto samplers = root["animations"][0]["samplers"].toArray();
    QVERIFY(!samplers.isEmpty());
    for (const QJsonValue& sampler : samplers) {
      const QJsonObject output = root["accessors"][sampler["output"].toInt()].toObject();
      if (output["type"] != "VEC4") continue;
      const QJsonObject view = root["bufferViews"][output["bufferView"].toInt()].toObject();
      const auto start = view["byteOffset"].toInt() + output["byteOffset"].toInt();
      QCOMPARE(data.mid(start, 16), data.mid(start + 16 * (output["count"].toInt() - 1), 16));
    }
  }

  void aClipGoesIntoAProjectOrIsRefused() {
    const QString project = folder_.filePath("baked.windfall");
    const test::ProgramRun done = run({plant(), "--bake", project, "--bake-seconds", "1"});
    QVERIFY2(done.status == 0, done.error.constData());
    QCOMPARE(test::runProgram(QStringLiteral(WINDFALL_PROGRAM), {"check", project}).status, 0);
    // A second one of the same wind has a name of its own.
    QVERIFY(run({project, "--bake", project, "--bake-seconds", "1"}).out.startsWith("Wind 5.0 m/s 2: "));
    const test::ProgramRun refused = run({plant(), "--bake", folder_.filePath("baked.obj")});
    QCOMPARE(refused.status, 1);
    QVERIFY(refused.error.contains("no format that keeps a clip"));
    QVERIFY(!QFile::exists(folder_.filePath("baked.obj")));
  }
};

WINDFALL_SUITE(SimulateCliTest)
#include "simulate_cli.moc"
