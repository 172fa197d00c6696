// `windfall new` and `windfall check` as a user of the shell sees them.
#include <QBuffer>
#include <QDir>
#include <QImage>
#include <QProcess>
#include <QTemporaryDir>
#include <QtTest>
#include <csignal>

#include "model/document/durable_file.h"
#include "model/document/project_file.h"
#include "support/rich_project.h"
#include "support/suite.h"

using namespace windfall;

namespace {

struct Outcome {
  int status = -1;
  QString output, errors;
};

Outcome windfallRun(const QStringList& arguments) {
  QProcess process;
  process.start(QStringLiteral(WINDFALL_PROGRAM), arguments);
  process.waitForFinished(-1);  // ctest has the limit: a slow machine is no failure
  return {process.exitStatus() == QProcess::NormalExit ? process.exitCode() : -1,
          QString::fromUtf8(process.readAllStandardOutput()), QString::fromUtf8(process.readAllStandardError())};
}

/// A project that is sound: no photo that can't be read, no file that is no plant.
model::Project soundProject() {
  model::Project project = test::richProject();
  project.leaves.pop_back();
  project.plants.pop_back();
  project.leaves[0].examples.clear();
  project.leaves[0].regionPairs.clear();
  project.plants[0].leaves = {{3}};
  project.scene.trees.pop_back();
  return project;
}

}  // namespace

class ProjectCommandsTest : public QObject {
  Q_OBJECT
 private slots:
  void checkSumsUpASoundProject();
  void checkNamesWhatIsWrong();
  void checkRefusesWhatIsNoProject();
  void usageIsTwo();
  void editorSaysWhyItCannotOpen();
  void newRefusesAPhotoWithoutALeaf();
  void newRefusesFilesThatAreNotThere();
  void newMakesTheSameSampleTwice();
  void anInterruptLeavesNothing();

 private:
  QString at(const QString& name) const { return folder_.filePath(name); }
  QTemporaryDir folder_;
};

void ProjectCommandsTest::checkSumsUpASoundProject() {
  model::Progress progress;
  const Status written = model::writeProject(soundProject(), at("sound.windfall"), progress);
  QVERIFY2(written, written ? "" : written.error().message.c_str());
  const Outcome outcome = windfallRun({"check", at("sound.windfall")});
  QCOMPARE(outcome.errors, QString());
  QCOMPARE(outcome.output, QString("1 leaf (2 textures), 1 plant, 1 tree in the scene; schema 1; sound\n"));
  QCOMPARE(outcome.status, 0);
}

void ProjectCommandsTest::checkNamesWhatIsWrong() {
  model::Progress progress;
  QVERIFY(model::writeProject(test::richProject(), at("rich.windfall"), progress));
  const Outcome outcome = windfallRun({"check", at("rich.windfall")});
  QCOMPARE(outcome.status, 1);
  const QStringList lines = outcome.errors.trimmed().split('\n');
  QCOMPARE(lines.size(), 2);
  QCOMPARE(lines[0], "windfall: " + at("rich.windfall") + ": leaf “Bare”: has no photo");
  QVERIFY2(lines[1].startsWith("windfall: " + at("rich.windfall") + ": plant “From file”: "), qPrintable(lines[1]));
  QVERIFY(outcome.output.endsWith("2 faults\n"));
}

void ProjectCommandsTest::checkRefusesWhatIsNoProject() {
  QVERIFY(model::writeDurably(at("text.windfall"), "hello"));
  for (const auto& [path, message] :
       std::map<QString, QString>{{at("text.windfall"), "is not a Windfall project, or only a part of one"},
                                  {at("nothing.windfall"), "there is no such file"},
                                  {folder_.path(), "is not a file"}}) {
    const Outcome outcome = windfallRun({"check", path});
    QCOMPARE(outcome.errors, "windfall: " + path + ": " + message + "\n");
    QCOMPARE(outcome.output, QString());
    QCOMPARE(outcome.status, 1);
  }
}

void ProjectCommandsTest::usageIsTwo() {
  QCOMPARE(windfallRun({"check"}).status, 2);
  QCOMPARE(windfallRun({"new"}).status, 2);
  QCOMPARE(windfallRun({"new", "-o", at("x.windfall"), "--nonsense"}).status, 2);
  QVERIFY(!QFileInfo::exists(at("x.windfall")));
}

void ProjectCommandsTest::editorSaysWhyItCannotOpen() {
  QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
  for (const char* display : {"DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"}) environment.remove(display);
  const auto errorsOf = [&](const QStringList& arguments) {
    QProcess process;
    process.setProcessEnvironment(environment);
    process.start(WINDFALL_PROGRAM, arguments);
    process.waitForFinished();
    return QString::number(process.exitCode()) + ' ' + QString::fromUtf8(process.readAllStandardError());
  };
  QCOMPARE(errorsOf({}), "1 windfall: the editor needs a display; render and shot make pictures without one\n");
  QCOMPARE(errorsOf({"bogus"}), "1 windfall: bogus: there is no such project, and no such command (see --help)\n");
}

void ProjectCommandsTest::newRefusesAPhotoWithoutALeaf() {
  QImage plain(300, 200, QImage::Format_RGB32);
  plain.fill(QColor(200, 200, 200));
  QVERIFY(plain.save(at("plain.png")));
  const Outcome outcome = windfallRun({"new", "-o", at("plain.windfall"), "--photo", at("plain.png")});
  QCOMPARE(outcome.status, 1);
  QVERIFY2(outcome.errors.startsWith("windfall: plain.png: ") && outcome.errors.count('\n') == 1,
           qPrintable(outcome.errors));
  QVERIFY(!QFileInfo::exists(at("plain.windfall")));
}

void ProjectCommandsTest::newRefusesFilesThatAreNotThere() {
  const Outcome photo = windfallRun({"new", "-o", at("x.windfall"), "--photo", at("none.jpg")});
  QCOMPARE(photo.status, 1);
  QVERIFY2(photo.errors.startsWith("windfall: " + at("none.jpg") + ": "), qPrintable(photo.errors));
  QVERIFY(model::writeDurably(at("not a plant.fbx"), "hello"));
  const Outcome plant = windfallRun({"new", "-o", at("x.windfall"), "--plant", at("not a plant.fbx")});
  QCOMPARE(plant.status, 1);
  QVERIFY2(plant.errors.startsWith("windfall: not a plant.fbx: "), qPrintable(plant.errors));
  QCOMPARE(windfallRun({"new", "-o", at("no such folder/x.windfall")}).errors,
           "windfall: " + at("no such folder/x.windfall") + ": its folder does not exist\n");
  QVERIFY(!QFileInfo::exists(at("x.windfall")));
}

void ProjectCommandsTest::newMakesTheSameSampleTwice() {
  QList<QByteArray> files;
  for (const QString& name : {at("one.windfall"), at("two.windfall")}) {
    const Outcome outcome = windfallRun({"new", "-o", name});
    QCOMPARE(outcome.errors, QString());
    QCOMPARE(outcome.status, 0);
    QFile file(name);
    QVERIFY(file.open(QIODevice::ReadOnly));
    files << file.readAll();
  }
  QVERIFY(files[0] == files[1]);
  model::Progress progress;
  const Result<model::Project> sample = model::readProject(at("one.windfall"), progress);
  QVERIFY2(sample, sample ? "" : sample.error().message.c_str());
  QCOMPARE(sample->leaves.size(), size_t(3));
  for (const model::Leaf& leaf : sample->leaves) {
    QVERIFY(!leaf.photo.isEmpty());
    QCOMPARE(leaf.variants.size(), size_t(3));
    for (const model::Variant& variant : leaf.variants) QVERIFY(variant.keep && !variant.image.isNull());
  }
  QCOMPARE(sample->scene.trees.size(), size_t(3));
  for (const model::Plant& plant : sample->plants) QVERIFY(!plant.leaves.empty());
  QCOMPARE(windfallRun({"check", at("one.windfall")}).status, 0);
}

void ProjectCommandsTest::anInterruptLeavesNothing() {
  QProcess process;
  process.start(QStringLiteral(WINDFALL_PROGRAM), {"new", "-o", at("cut.windfall")});
  QVERIFY(process.waitForStarted());
  // Interrupted again and again until it ends: the first ones may come before it listens.
  while (!process.waitForFinished(20)) ::kill(static_cast<pid_t>(process.processId()), SIGINT);
  if (process.exitStatus() == QProcess::NormalExit) {
    QCOMPARE(process.exitCode(), 130);
    QCOMPARE(QString::fromUtf8(process.readAllStandardError()), QString("windfall: cancelled\n"));
  }
  QVERIFY(QDir(folder_.path()).entryList({"cut*"}).isEmpty());
}

WINDFALL_SUITE(ProjectCommandsTest)
#include "project_commands.moc"
