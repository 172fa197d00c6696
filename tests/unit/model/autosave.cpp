// Recovery: written only while there is something to lose, offered only after a crash, deleted only by decision.
#include "model/document/autosave.h"

#include <QProcess>
#include <QTemporaryDir>
#include <QtTest>
#include <csignal>

#include "model/document/durable_file.h"
#include "model/document/project_file.h"
#include "support/rich_project.h"
#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;

namespace {

constexpr const char* kFolderVariable = "WINDFALL_TEST_CRASH_FOLDER";

QStringList filesIn(const QString& folder) { return QDir(folder).entryList(QDir::Files, QDir::Name); }

}  // namespace

class AutosaveTest : public QObject {
  Q_OBJECT
 private slots:
  /// Run by other tests in a process of its own, which it kills after an autosave.
  void crash();
  void aModifiedDocumentIsKeptAndAnUnmodifiedOneIsNot();
  void aLivingSessionIsNotOffered();
  void aKilledSessionIsOfferedAndRecovered();
  void workThatTheUsersFileHasIsNotOfferedAndNotDeleted();
  void aDamagedRecoveryFileChangesNothing();

 private:
  /// A session that edits the project at `original` (or a new one), autosaves and is killed.
  void runCrash(const QString& folder, const QString& original);
};

void AutosaveTest::crash() {
  const QString folder = qEnvironmentVariable(kFolderVariable);
  if (folder.isEmpty()) return;
  Document document;
  Autosave autosave(document, folder + "/recovery");
  Progress progress;
  const QString original = folder + "/original.windfall";
  if (QFileInfo::exists(original)) QVERIFY(document.load(original, progress));
  Leaf leaf;
  leaf.name = "Unsaved";
  document.addLeaf(leaf);
  autosave.saveNow();
  autosave.waitForSave();
  ::raise(SIGKILL);
}

void AutosaveTest::runCrash(const QString& folder, const QString& original) {
  QProcess process;
  QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
  environment.insert(kFolderVariable, folder);
  process.setProcessEnvironment(environment);
  if (!original.isEmpty()) {
    Progress progress;
    QVERIFY(writeProject(test::richProject(), original, progress));
  }
  process.start(QCoreApplication::applicationFilePath(), {"autosave", "crash"});
  QVERIFY(process.waitForFinished(60'000));
  QCOMPARE(process.exitStatus(), QProcess::CrashExit);
}

void AutosaveTest::aModifiedDocumentIsKeptAndAnUnmodifiedOneIsNot() {
  QTemporaryDir folder;
  Document document;
  document.open(test::richProject(), folder.filePath("mine.windfall"));
  {
    Autosave autosave(document, folder.filePath("recovery"));
    autosave.saveNow();
    autosave.waitForSave();
    QVERIFY(!QFileInfo::exists(autosave.file()));
    document.addLeaf({});
    autosave.saveNow();
    autosave.waitForSave();
    Progress progress;
    QCOMPARE(*readProject(autosave.file(), progress), document.project());
    QVERIFY(!QFileInfo::exists(document.path()));

    document.undoStack().undo();
    QVERIFY(!QFileInfo::exists(autosave.file()));
    document.undoStack().redo();
    autosave.saveNow();
    autosave.waitForSave();
    QVERIFY(QFileInfo::exists(autosave.file()));
    QVERIFY(document.save(folder.filePath("mine.windfall"), progress));
    QVERIFY(!QFileInfo::exists(autosave.file()));

    document.addLeaf({});
    autosave.saveNow();  // still being written when the session ends
  }
  QCOMPARE(filesIn(folder.filePath("recovery")), QStringList());
}

void AutosaveTest::aLivingSessionIsNotOffered() {
  QTemporaryDir folder;
  Document document;
  Autosave autosave(document, folder.path());
  document.addLeaf({});
  autosave.saveNow();
  autosave.waitForSave();
  QVERIFY(QFileInfo::exists(autosave.file()));
  QVERIFY(findRecoveries(folder.path()).empty());
}

void AutosaveTest::aKilledSessionIsOfferedAndRecovered() {
  QTemporaryDir folder;
  const QString original = folder.filePath("original.windfall"), kept = folder.filePath("recovery");
  runCrash(folder.path(), original);
  const std::vector<Recovery> found = findRecoveries(kept);
  QCOMPARE(found.size(), size_t(1));
  QCOMPARE(found[0].original, original);

  Document document;
  Autosave autosave(document, kept);
  Progress progress;
  QVERIFY(autosave.recover(found[0], progress));
  QCOMPARE(document.project().leaves.back().name, QString("Unsaved"));
  QCOMPARE(document.path(), original);
  QVERIFY(document.isModified());
  QVERIFY(QFileInfo::exists(autosave.file()));
  QVERIFY(findRecoveries(kept).empty());
  QVERIFY(document.save(original, progress));
  QVERIFY(!QFileInfo::exists(autosave.file()));
}

void AutosaveTest::workThatTheUsersFileHasIsNotOfferedAndNotDeleted() {
  QTemporaryDir folder;
  const QString kept = folder.filePath("recovery"), original = folder.filePath("original.windfall");
  runCrash(folder.path(), original);
  const std::vector<Recovery> found = findRecoveries(kept);
  QCOMPARE(found.size(), size_t(1));
  // The same work, saved by hand, with another camera.
  Progress progress;
  Project same = *readProject(found[0].file, progress);
  same.view.camera.distance = 77;
  QVERIFY(writeProject(same, original, progress));
  const QDateTime then = QFileInfo(found[0].file).lastModified();
  QFile touched(original);
  QVERIFY(touched.open(QIODevice::ReadWrite));
  QVERIFY(touched.setFileTime(then.addSecs(-5), QFileDevice::FileModificationTime));
  touched.close();
  QVERIFY(findRecoveries(kept).empty());
  QVERIFY(QFileInfo::exists(found[0].file));

  // Different, but newer than the recovery file: saved after it.
  QVERIFY(writeProject(test::richProject(), original, progress));
  QVERIFY(touched.open(QIODevice::ReadWrite));
  QVERIFY(touched.setFileTime(then.addSecs(5), QFileDevice::FileModificationTime));
  touched.close();
  QVERIFY(findRecoveries(kept).empty());
  QVERIFY(QFileInfo::exists(found[0].file));

  QVERIFY(QFile::remove(original));
  QCOMPARE(findRecoveries(kept).size(), size_t(1));
  discardRecovery(found[0]);
  QVERIFY(findRecoveries(kept).empty());
}

void AutosaveTest::aDamagedRecoveryFileChangesNothing() {
  QTemporaryDir folder;
  const QString file = folder.filePath("dead.windfall");
  QVERIFY(writeDurably(file, "half of a fi"));
  const std::vector<Recovery> found = findRecoveries(folder.path());
  QCOMPARE(found.size(), size_t(1));
  Document document;
  document.open(test::richProject(), "x");
  Autosave autosave(document, folder.path());
  Progress progress;
  QVERIFY(!autosave.recover(found[0], progress));
  QCOMPARE(document.project(), test::richProject());
  QVERIFY(QFileInfo::exists(file));
}

WINDFALL_SUITE(AutosaveTest)
#include "autosave.moc"
