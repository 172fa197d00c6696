// A damaged, newer or hostile project file gets one clear line that names the place.
#include <QBuffer>
#include <QTemporaryDir>
#include <QtTest>

#include "model/document/archive.h"
#include "model/document/durable_file.h"
#include "model/document/project_file.h"
#include "support/raw_zip.h"
#include "support/rich_project.h"
#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;
using test::RawEntry;

namespace {

/// project.json that is well but for `text`, which is put in.
QByteArray json(const QByteArray& text) {
  return "{\"schema\": 1, \"nextId\": 100" + (text.isEmpty() ? "" : ", " + text) + "}";
}
QByteArray leaves(const QByteArray& items) { return json("\"leaves\": {\"version\": 1, \"leaves\": [" + items + "]}"); }
QByteArray plants(const QByteArray& items) { return json("\"plants\": {\"version\": 1, \"plants\": [" + items + "]}"); }

QByteArray png(QSize size) {
  QByteArray bytes;
  QBuffer buffer(&bytes);
  buffer.open(QIODevice::WriteOnly);
  QImage image(size, QImage::Format_Grayscale8);
  image.fill(255);
  image.save(&buffer, "png");
  return bytes;
}

/// A PNG whose header promises another size.
QByteArray pngThatClaims(quint32 width, quint32 height) {
  QByteArray bytes = png({4, 4});
  qToBigEndian(width, bytes.data() + 16);
  qToBigEndian(height, bytes.data() + 20);
  qToBigEndian(test::crc32Of(bytes.mid(12, 17)), bytes.data() + 29);
  return bytes;
}

}  // namespace

Q_DECLARE_METATYPE(QList<windfall::test::RawEntry>)

class ProjectFileHostileTest : public QObject {
  Q_OBJECT
 private slots:
  void filesThatAreNoProject_data();
  void filesThatAreNoProject();
  void archives_data();
  void archives();
  void contents_data();
  void contents();
  void limitsCountWhatIsReallyInflated();

 private:
  QString errorOf(const QString& path) {
    Progress progress;
    const Result<Project> read = readProject(path, progress);
    return read ? QString() : QString::fromStdString(read.error().message);
  }
  QString errorOf(const QByteArray& file) {
    const QString path = folder_.filePath("x.windfall");
    return writeDurably(path, file) ? errorOf(path) : QString("not written");
  }
  QTemporaryDir folder_;
};

void ProjectFileHostileTest::filesThatAreNoProject_data() {
  QTest::addColumn<QByteArray>("file");
  QTest::addColumn<QString>("message");
  const QByteArray whole = test::rawZip({{"project.json", json("")}});
  QTest::newRow("empty") << QByteArray() << "is empty";
  QTest::newRow("text") << QByteArray("hello") << "is not a Windfall project, or only a part of one";
  QTest::newRow("truncated") << whole.chopped(30) << "is not a Windfall project, or only a part of one";
  QTest::newRow("other zip") << test::rawZip({{"readme.txt", "hi"}})
                             << "is not a Windfall project: project.json is missing in it";
}

void ProjectFileHostileTest::filesThatAreNoProject() {
  QFETCH(QByteArray, file);
  QFETCH(QString, message);
  QCOMPARE(errorOf(file), message);
  QCOMPARE(errorOf(folder_.path()), QString("is not a file"));
  QCOMPARE(errorOf(folder_.filePath("nothing")), QString("there is no such file"));
}

void ProjectFileHostileTest::archives_data() {
  QTest::addColumn<QList<RawEntry>>("entries");
  QTest::addColumn<QString>("message");
  const RawEntry good{"project.json", json("")};
  const auto row = [&](const char* name, RawEntry second, const char* message) {
    QTest::newRow(name) << QList<RawEntry>{good, second} << QString::fromUtf8(message);
  };
  row("parent folder", {"../../evil.png", "x"}, "entry “../../evil.png” leads out of the file");
  row("parent folder within", {"leaves/../../evil.png", "x"}, "entry “leaves/../../evil.png” leads out of the file");
  row("absolute", {"/etc/passwd", "x"}, "entry “/etc/passwd” has an absolute path");
  row("drive", {"C:evil", "x"}, "entry “C:evil” has an absolute path");
  row("backslash", {"..\\evil", "x"}, "entry “..\\evil” has a backslash in its name");
  row("line break", {"a\nb", "x"}, "entry “a b” has a control character in its name");
  row("twice", good, "entry “project.json” is there twice");
  row("link", {"leaves/link", "/etc/passwd", false, -1, 0x0800, 0120777}, "entry “leaves/link” is a link");
  row("encrypted", {"secret", "xxxxxxxxxxxxxxxx", false, -1, 0x0801}, "entry “secret” is encrypted");

  RawEntry wrong = good;
  wrong.wrongChecksum = true;
  QTest::newRow("checksum") << QList<RawEntry>{wrong} << "“project.json” is damaged";
  RawEntry modest{"project.json", json("\"x\": \"" + QByteArray(1 << 20, 'a') + "\""), true, 100};
  QTest::newRow("holds more than it says") << QList<RawEntry>{modest} << "“project.json” holds more than it says";
  RawEntry boastful = good;
  boastful.deflate = true;
  boastful.claimedSize = 1 << 20;
  QTest::newRow("holds less than it says") << QList<RawEntry>{boastful} << "“project.json” is cut off";
  boastful.claimedSize = qint64(2) << 30;
  QTest::newRow("promises gigabytes") << QList<RawEntry>{boastful}
                                      << "“project.json” is larger than the 268435456 bytes that are read";
}

void ProjectFileHostileTest::archives() {
  QFETCH(QList<RawEntry>, entries);
  QFETCH(QString, message);
  QCOMPARE(errorOf(test::rawZip(entries)), message);
}

void ProjectFileHostileTest::contents_data() {
  QTest::addColumn<QByteArray>("project");
  QTest::addColumn<QString>("message");
  const auto row = [](const char* name, const QByteArray& project, const char* message) {
    QTest::newRow(name) << project << QString::fromUtf8(message);
  };
  row("no json", "{\n\n oops", "project.json: line 3: unterminated object");
  row("a list", "[]", "project.json: is not an object");
  row("deep", QByteArray(100'000, '['), "project.json: is nested deeper than 64 levels");
  row("no schema", "{}", "schema: is missing or not a version number");
  row("odd schema", R"({"schema": -1})", "schema: is missing or not a version number");
  row("newer", R"({"schema": 7})", "was written by a newer Windfall (schema 7; this one reads up to 1)");
  row("newer domain", json(R"("scene": {"version": 3})"),
      "scene: was written by a newer Windfall (version 3; this one reads up to 1)");
  row("domain without version", json(R"("scene": {})"), "scene: has no known version");
  row("domain of wrong type", json(R"("leaves": [])"), "leaves: is not an object");
  row("no nextId", R"({"schema": 1})", "nextId: is missing");

  row("wrong type", leaves(R"({"id": 1, "name": 5})"), "leaves[0].name: is not text");
  row("item of wrong type", leaves("7"), "leaves[0]: is not an object");
  row("no id", leaves(R"({"name": "x"})"), "leaves[0].id: is missing");
  row("id 0", leaves(R"({"id": 0})"), "leaves[0].id: is 0, expected 1 to 9.0072e+15");
  row("id of the future", leaves(R"({"id": 100})"), "leaves[0].id: is 100, not below nextId (100)");
  row("id twice", leaves(R"({"id": 1}, {"id": 1})"), "leaves[1].id: 1 is there twice");
  row("huge number", leaves(R"({"id": 1, "bladeLength": 1e300})"),
      "leaves[0].bladeLength: is 1e+300, expected 0.0001 to 100");
  row("no number", leaves(R"({"id": 1, "bladeLength": null})"), "leaves[0].bladeLength: is not a number");
  row("NaN", leaves(R"({"id": 1, "bladeLength": NaN})"), "project.json: line 1: illegal number");
  row("fraction", leaves(R"({"id": 1, "parameters": {"veins": {"laterals": 2.5}}})"),
      "leaves[0].parameters.veins.laterals: is 2.5, expected a whole number");
  row("seed", leaves(R"({"id": 1, "parameters": {"veins": {"seed": "-4"}}})"),
      "leaves[0].parameters.veins.seed: is not a whole number");
  row("half a point", leaves(R"({"id": 1, "markers": [1, 2, 3]})"), "leaves[0].markers: has an x without its y");
  row("text for a point", leaves(R"({"id": 1, "markers": [1, 2, 3, "x"]})"), "leaves[0].markers[1]: is not a point");
  row("vein without parent", leaves(R"({"id": 1, "veins": [{"parent": 5}]})"),
      "leaves[0].veins[0].parent: leads nowhere");
  row("veins in a circle", leaves(R"({"id": 1, "veins": [{"parent": -1}, {"parent": 2}, {"parent": 1}]})"),
      "leaves[0].veins[1].parent: leads nowhere");

  row("missing entry", leaves(R"({"id": 1}, {"id": 2, "mask": "leaves/2/mask.png"})"),
      "leaves[1].mask: “leaves/2/mask.png” is missing in the file");
  row("path out", leaves(R"({"id": 1, "photo": {"name": "x", "file": "/etc/passwd"}})"),
      "leaves[0].photo.file: “/etc/passwd” is missing in the file");
  row("name with folders", leaves(R"({"id": 1, "photo": {"name": "../x", "file": "a.png"}})"),
      "leaves[0].photo.name: is not a plain file name");
  row("no picture", leaves(R"({"id": 1, "mask": "text.png"})"), "leaves[0].mask: is not a PNG picture");
  row("damaged picture", leaves(R"({"id": 1, "mask": "damaged.png"})"), "leaves[0].mask: is a damaged PNG picture");
  row("picture bomb", leaves(R"({"id": 1, "mask": "bomb.png"})"), "leaves[0].mask: is too large: 60000 × 60000 px");
  row("mask of another size", leaves(R"({"id": 1, "photo": {"name": "a.png", "file": "a.png"}, "mask": "b.png"})"),
      "leaves[0].mask: is 5 × 4 px, its photo 9 × 8 px");

  row("plant of no leaf", plants(R"({"id": 1, "leaves": [2]})"), "plants[0].leaves: there is no leaf 2");
  row("plant of odd leaf", plants(R"({"id": 1, "leaves": [-2]})"), "plants[0].leaves[0]: is not an id");
  row("edit of wrong type", plants(R"({"id": 1, "edits": {"trunk": 1}})"), "plants[0].edits[trunk]: is not an object");
  row("grower", plants(R"({"id": 1, "grower": {"levels": 99}})"), "plants[0].grower.levels: is 99, expected 1 to 8");
  row("tree of no plant", json(R"("scene": {"version": 1, "trees": [{"id": 1, "plant": 9}]})"),
      "scene.trees[0].plant: there is no plant 9");
  row("position", json(R"("scene": {"version": 1, "trees": [{"id": 1, "plant": 9, "position": [1, 2]}]})"),
      "scene.trees[0].position: is not three numbers from -1e+06 to 1e+06");
  row("wind", json(R"("scene": {"version": 1, "wind": {"speed": -3}})"), "scene.wind.speed: is -3, expected 0 to 200");
  row("camera", json(R"("view": {"version": 1, "camera": {"fieldOfView": 0}})"),
      "view.camera.fieldOfView: is 0, expected 1 to 179");
}

void ProjectFileHostileTest::contents() {
  QFETCH(QByteArray, project);
  QFETCH(QString, message);
  QByteArray damaged = png({200, 200});
  damaged.truncate(damaged.size() / 2);
  const QString error = errorOf(test::rawZip({{"project.json", project},
                                              {"text.png", "hello"},
                                              {"damaged.png", damaged},
                                              {"bomb.png", pngThatClaims(60000, 60000)},
                                              {"a.png", png({9, 8})},
                                              {"b.png", png({5, 4})}}));
  QCOMPARE(error, message);
  QVERIFY(!error.contains('\n'));
}

void ProjectFileHostileTest::limitsCountWhatIsReallyInflated() {
  const QString path = folder_.filePath("limits.windfall");
  const QByteArray zeros(1 << 20, '\0');
  QVERIFY(writeDurably(path, test::rawZip({{"a", zeros, true}, {"b", zeros, true}, {"lie", zeros, true, 1000}})));
  Progress progress;
  Result<ArchiveReader> archive = ArchiveReader::open(path, {3, 2 << 20, (1 << 20) + 1000});
  QVERIFY(archive);
  QVERIFY(!archive->read("a", 1000, progress));
  QVERIFY(!archive->read("lie", 1 << 20, progress));
  QVERIFY(archive->read("a", 1 << 20, progress));
  const Result<QByteArray> second = archive->read("b", 1 << 20, progress);
  QVERIFY(!second);
  QCOMPARE(QString::fromStdString(second.error().message), QString("“b” is larger than the 1000 bytes that are read"));
  const Result<ArchiveReader> few = ArchiveReader::open(path, {2, 2 << 20, 2 << 20});
  QVERIFY(!few);
  QCOMPARE(QString::fromStdString(few.error().message), QString("has 3 entries, 2 at most are read"));
}

WINDFALL_SUITE(ProjectFileHostileTest)
#include "project_file_hostile.moc"
