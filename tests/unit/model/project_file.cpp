// The .windfall file keeps everything, gives equal bytes for equal projects, and never replaces a file by half of one.
#include "model/document/project_file.h"

#include <QJsonDocument>
#include <QTemporaryDir>
#include <QtTest>

#include "model/document/archive.h"
#include "model/document/document.h"
#include "model/document/durable_file.h"
#include "support/raw_zip.h"
#include "support/rich_project.h"
#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;

class ProjectFileTest : public QObject {
  Q_OBJECT
 private slots:
  void everythingComesBack();
  void saveLoadSaveGivesEqualBytes();
  void bytesKnowNoTimeZone();
  void bytesKnowNoScreen();
  void numbersSurviveExactly();
  void sourcesStandBesideAsTheyWere();
  void anOlderSchemaIsUpgraded();
  void aFailedSaveLeavesTheOldFile();
  void aBrokenProjectIsNotSaved();
  void cancellingWritesNothing();
  void saveOverALinkReplacesItsTarget();
  void theDocumentIsCleanAfterSavingAndUnchangedByAFailedLoad();

 private:
  QString at(const QString& name) const { return folder_.filePath(name); }
  static QByteArray bytesOf(const QString& path) {
    QFile file(path);
    return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
  }
  Status write(const Project& project, const QString& name) {
    Progress progress;
    return writeProject(project, at(name), progress);
  }
  Result<Project> read(const QString& name) {
    Progress progress;
    return readProject(at(name), progress);
  }
  QTemporaryDir folder_;
};

void ProjectFileTest::everythingComesBack() {
  const Project project = test::richProject();
  QVERIFY(write(project, "rich.windfall"));
  const Result<Project> back = read("rich.windfall");
  QVERIFY2(back, back ? "" : back.error().message.c_str());
  QCOMPARE(back->leaves, project.leaves);
  QCOMPARE(back->plants, project.plants);
  QCOMPARE(back->scene, project.scene);
  QCOMPARE(back->view, project.view);
  QCOMPARE(*back, project);
  QVERIFY(write(Project{}, "empty.windfall"));
  QCOMPARE(*read("empty.windfall"), Project{});
}

void ProjectFileTest::saveLoadSaveGivesEqualBytes() {
  QVERIFY(write(test::richProject(), "first.windfall"));
  QVERIFY(write(*read("first.windfall"), "second.windfall"));
  QVERIFY(bytesOf(at("first.windfall")).size() > 1000);
  QCOMPARE(bytesOf(at("first.windfall")), bytesOf(at("second.windfall")));
}

void ProjectFileTest::bytesKnowNoTimeZone() {
  const QByteArray zone = qgetenv("TZ");
  QList<QByteArray> seen;
  for (const char* name : {"UTC", "Pacific/Auckland", "America/Los_Angeles"}) {
    qputenv("TZ", name);
    ::tzset();
    QVERIFY(write(test::richProject(), "zone.windfall"));
    seen << bytesOf(at("zone.windfall"));
  }
  zone.isEmpty() ? qunsetenv("TZ") : qputenv("TZ", zone);
  ::tzset();
  QCOMPARE(seen[1], seen[0]);
  QCOMPARE(seen[2], seen[0]);
}

void ProjectFileTest::bytesKnowNoScreen() {
  Project project = test::richProject();
  QVERIFY(write(project, "screen.windfall"));
  const QByteArray first = bytesOf(at("screen.windfall"));
  project.leaves[0].mask.setDotsPerMeterX(7777);
  project.leaves[0].mask.setText("Author", "me");
  QVERIFY(write(project, "screen.windfall"));
  QCOMPARE(bytesOf(at("screen.windfall")), first);
}

void ProjectFileTest::numbersSurviveExactly() {
  Project project;
  project.nextId = 9007199254740991ULL;
  Leaf leaf;
  leaf.id = {9007199254740990ULL};
  leaf.name = "x";
  quint64 state = 1;
  for (int i = 0; i < 2000; ++i) {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    const double share = static_cast<double>(state >> 11) / 9007199254740992.0;
    leaf.markers.emplace_back(share * std::pow(10.0, i % 12 - 6), -share);
  }
  leaf.markers.emplace_back(5e-324, 0.1 + 0.2);
  project.leaves = {leaf};
  project.scene.wind.speed = 0.1f;
  project.scene.wind.until = 3.4e37f;
  QVERIFY(write(project, "numbers.windfall"));
  const Result<Project> back = read("numbers.windfall");
  QVERIFY2(back, back ? "" : back.error().message.c_str());
  QVERIFY(*back == project);
  for (size_t i = 0; i < leaf.markers.size(); ++i) {
    // QPointF compares fuzzily.
    QVERIFY(back->leaves[0].markers[i].x() == leaf.markers[i].x() &&
            back->leaves[0].markers[i].y() == leaf.markers[i].y());
  }
}

void ProjectFileTest::sourcesStandBesideAsTheyWere() {
  const Project project = test::richProject();
  QVERIFY(write(project, "rich.windfall"));
  Progress progress;
  Result<ArchiveReader> archive = ArchiveReader::open(at("rich.windfall"));
  QVERIFY(archive);
  QCOMPARE(archive->names(),
           (QStringList{"leaves/3/mask.png", "leaves/3/photo.png", "leaves/3/variants/0001.png", "plants/5/crown.obj",
                        "plants/6/source.fbx", "project.json", "simulation/state.bin"}));
  QCOMPARE(*archive->read("leaves/3/photo.png", 1 << 20, progress), project.leaves[0].photo.bytes);
  QCOMPARE(*archive->read("plants/6/source.fbx", 1 << 20, progress), project.plants[1].file.bytes);
  const QImage mask = QImage::fromData(*archive->read("leaves/3/mask.png", 1 << 20, progress), "png");
  QCOMPARE(mask, project.leaves[0].mask);
  const QJsonObject json = QJsonDocument::fromJson(*archive->read("project.json", 1 << 20, progress)).object();
  QCOMPARE(json.keys(), (QStringList{"atlas", "leaves", "nextId", "plants", "scene", "schema", "simulation", "view"}));
  for (const QString domain : {"atlas", "leaves", "plants", "scene", "simulation", "view"}) {
    QCOMPARE(json[domain]["version"].toInt(), 1);
  }
}

void ProjectFileTest::anOlderSchemaIsUpgraded() {
  const QByteArray old =
      R"({"schema": 0, "nextId": 9, "leaves": [{"id": 3, "name": "Oak", "lengthInCentimetres": 12}]})";
  QVERIFY(writeDurably(at("old.windfall"), test::rawZip({{"project.json", old}})));
  const Result<Project> project = read("old.windfall");
  QVERIFY2(project, project ? "" : project.error().message.c_str());
  QCOMPARE(project->leaves.size(), size_t(1));
  QCOMPARE(project->leaves[0].name, QString("Oak"));
  QCOMPARE(project->leaves[0].bladeLength, 0.12);
}

void ProjectFileTest::aFailedSaveLeavesTheOldFile() {
  QVERIFY(QDir(folder_.path()).mkdir("folder.windfall"));
  QVERIFY(!write(Project{}, "folder.windfall"));
  QVERIFY(!write(Project{}, "no such folder/x.windfall"));
  QVERIFY(QFileInfo(at("folder.windfall")).isDir());
  QCOMPARE(QDir(folder_.path()).entryList({"folder*"}, QDir::AllEntries).size(), 1);
}

void ProjectFileTest::aBrokenProjectIsNotSaved() {
  QVERIFY(write(test::richProject(), "good.windfall"));
  const QByteArray before = bytesOf(at("good.windfall"));
  Project broken = test::richProject();
  broken.scene.wind.speed = std::nanf("");
  Status status = write(broken, "good.windfall");
  QVERIFY(!status);
  QCOMPARE(QString::fromStdString(status.error().message),
           QString("cannot be saved: scene.wind.speed: is nan, expected 0 to 200"));
  broken = test::richProject();
  broken.plants[0].leaves.push_back({1000});
  status = write(broken, "good.windfall");
  QVERIFY(!status);
  QCOMPARE(QString::fromStdString(status.error().message),
           QString("cannot be saved: plants[0].leaves: there is no leaf 1000"));
  QCOMPARE(bytesOf(at("good.windfall")), before);
}

void ProjectFileTest::cancellingWritesNothing() {
  Progress progress;
  progress.cancel();
  const Status status = writeProject(test::richProject(), at("never.windfall"), progress);
  QVERIFY(!status);
  QVERIFY(status.error().cancelled);
  QVERIFY(!QFileInfo::exists(at("never.windfall")));
  QVERIFY(write(test::richProject(), "there.windfall"));
  const Result<Project> read = readProject(at("there.windfall"), progress);
  QVERIFY(!read && read.error().cancelled);
}

void ProjectFileTest::saveOverALinkReplacesItsTarget() {
  QVERIFY(write(Project{}, "real.windfall"));
  QVERIFY(QFile::link(at("real.windfall"), at("link.windfall")));
  QVERIFY(write(test::richProject(), "link.windfall"));
  QVERIFY(QFileInfo(at("link.windfall")).isSymLink());
  QCOMPARE(*read("real.windfall"), test::richProject());
}

void ProjectFileTest::theDocumentIsCleanAfterSavingAndUnchangedByAFailedLoad() {
  Document document;
  Progress progress;
  const AssetId leaf = document.addLeaf({});
  QVERIFY(document.isModified());
  QVERIFY(document.save(at("doc.windfall"), progress));
  QVERIFY(!document.isModified());
  QCOMPARE(document.path(), at("doc.windfall"));
  document.rename(leaf, "Oak");
  const Project before = document.project();
  QVERIFY(writeDurably(at("bad.windfall"), "no zip at all"));
  QVERIFY(!document.load(at("bad.windfall"), progress));
  QCOMPARE(document.project(), before);
  QVERIFY(document.isModified());
  QVERIFY(document.undoStack().canUndo());
  QVERIFY(document.load(at("doc.windfall"), progress));
  QVERIFY(!document.isModified());
  QCOMPARE(document.project().leaf(leaf)->name, QString("Leaf"));
}

WINDFALL_SUITE(ProjectFileTest)
#include "project_file.moc"
