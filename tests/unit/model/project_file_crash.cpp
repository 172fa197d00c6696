// A program that is killed while it saves leaves the old file or the new one, never a part.
#include <QProcess>
#include <QTemporaryDir>
#include <QtTest>
#include <cstdio>

#include "model/document/project_file.h"
#include "support/rich_project.h"
#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;

namespace {

constexpr const char* kFileVariable = "WINDFALL_TEST_SAVE_FILE";
constexpr int kKills = 8;

/// Two projects of different size; the large one takes long enough to be killed in.
Project projectOf(bool large) {
  Project project = test::richProject();
  project.scene.seed = large ? 1 : 2;
  if (large) {
    const QImage noise = test::noisePicture({500, 500}, QImage::Format_RGBA8888, 3);
    project.simulation.bytes = QByteArray(reinterpret_cast<const char*>(noise.constBits()), noise.sizeInBytes());
  }
  return project;
}

}  // namespace

class ProjectFileCrashTest : public QObject {
  Q_OBJECT
 private slots:
  /// Run by the other test in a process of its own: saves one and the other until it is killed.
  void saveForever();
  void aKilledSaveLeavesAWholeFile();
};

void ProjectFileCrashTest::saveForever() {
  const QString path = qEnvironmentVariable(kFileVariable);
  if (path.isEmpty()) return;
  const Project projects[] = {projectOf(false), projectOf(true)};
  Progress progress;
  for (int i = 0;; ++i) {
    if (!writeProject(projects[i % 2], path, progress)) return;
    std::fputc('#', stderr);
  }
}

void ProjectFileCrashTest::aKilledSaveLeavesAWholeFile() {
  QTemporaryDir folder;
  const QString path = folder.filePath("mine.windfall");
  const Project projects[] = {projectOf(false), projectOf(true)};
  Progress progress;
  QVERIFY(writeProject(projects[0], path, progress));
  QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
  environment.insert(kFileVariable, path);
  for (int kill = 0; kill < kKills; ++kill) {
    QProcess process;
    process.setProcessEnvironment(environment);
    process.start(QCoreApplication::applicationFilePath(), {"project_file_crash", "saveForever"});
    QVERIFY(process.waitForStarted());
    // After a different number of saves each time; where in the next one it dies is the system's dice.
    process.setReadChannel(QProcess::StandardError);
    for (qsizetype saves = 0; saves < 1 + kill % 4; saves += process.readAll().count('#')) {
      QVERIFY(process.waitForReadyRead(60'000));
    }
    process.kill();
    QVERIFY(process.waitForFinished(60'000));
    const Result<Project> read = readProject(path, progress);
    QVERIFY2(read, read ? "" : read.error().message.c_str());
    QVERIFY(*read == projects[0] || *read == projects[1]);
  }
}

WINDFALL_SUITE(ProjectFileCrashTest)
#include "project_file_crash.moc"
