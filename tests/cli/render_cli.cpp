// windfall render, as typed by a user.
#include <QImage>
#include <QTemporaryDir>
#include <QtTest>

#include "model/document/project_file.h"
#include "support/program_fixture.h"
#include "support/suite.h"

using namespace windfall;

class RenderCliTest : public QObject {
  Q_OBJECT
 private slots:
  void initTestCase();
  void framesAreWrittenInTheirSize();
  void badFilesAndUsageHaveTheirStatus_data();
  void badFilesAndUsageHaveTheirStatus();

 private:
  test::ProgramRun render(const QStringList& arguments) const {
    return test::runProgram(QStringLiteral(WINDFALL_PROGRAM), QStringList{"render"} + arguments, false);
  }
  QString project() const { return folder_.filePath("tree.windfall"); }
  QTemporaryDir folder_;
};

void RenderCliTest::initTestCase() {
  // A grown tree that sheds a few leaves.
  model::Project project;
  model::Plant plant;
  plant.id = {1};
  plant.name = "Tree";
  plant.grower = model::GrowerSettings{};
  plant.grower->limbs = 8;
  plant.grower->levels = 2;
  project.plants.push_back(plant);
  model::TreePlacement tree;
  tree.id = {2};
  tree.name = "Tree";
  tree.plant = {1};
  project.scene.trees.push_back(tree);
  project.scene.leaves.count = 50;
  project.nextId = 3;
  model::Progress progress;
  const Status written = model::writeProject(project, this->project(), progress);
  QVERIFY2(bool(written), written ? "" : written.error().message.c_str());
}

void RenderCliTest::framesAreWrittenInTheirSize() {
  const QString folder = folder_.filePath("frames");
  const test::ProgramRun run =
      render({project(), "--frames", "2-5", "--fps", "2", "--size", "96x64", "--quality", "draft", "-o", folder});
  if (run.status == 1 && run.error.contains("needs OpenGL 4.5")) QSKIP("no OpenGL 4.5 here");
  QVERIFY2(run.status == 0, run.error.constData());
  const QStringList files = QDir(folder).entryList(QDir::Files, QDir::Name);
  QCOMPARE(files, (QStringList{"frame_0002.png", "frame_0003.png", "frame_0004.png", "frame_0005.png"}));
  const QImage first(folder + "/frame_0002.png"), last(folder + "/frame_0005.png");
  QCOMPARE(first.size(), QSize(96, 64));
  // The tree moves, the world stands.
  QVERIFY(first != last);
}

void RenderCliTest::badFilesAndUsageHaveTheirStatus_data() {
  QTest::addColumn<QStringList>("arguments");
  QTest::addColumn<int>("status");
  QTest::addColumn<QString>("says");
  const QString tree = project(), out = folder_.filePath("out"), png = folder_.filePath("out.png");
  QTest::newRow("no such project") << QStringList{folder_.filePath("none.windfall"), "-o", out} << 1 << "none.windfall";
  QTest::newRow("frames backwards") << QStringList{tree, "--frames", "5-2", "-o", out} << 2 << "--frames";
  QTest::newRow("frame zero") << QStringList{tree, "--frames", "0-2", "-o", out} << 2 << "--frames";
  QTest::newRow("tiny") << QStringList{tree, "--size", "4x4", "-o", out} << 2 << "--size";
  QTest::newRow("no size") << QStringList{tree, "--size", "wide", "-o", out} << 2 << "--size";
  QTest::newRow("no speed") << QStringList{tree, "--fps", "0", "-o", out} << 2 << "--fps";
  QTest::newRow("film") << QStringList{tree, "-o", folder_.filePath("out.mp4")} << 2 << "out.mp4";
  QTest::newRow("frames in one picture") << QStringList{tree, "--frames", "1-3", "-o", png} << 2 << "-o DIR";
}

void RenderCliTest::badFilesAndUsageHaveTheirStatus() {
  QFETCH(QStringList, arguments);
  QFETCH(int, status);
  QFETCH(QString, says);
  const test::ProgramRun run = render(arguments);
  QCOMPARE(run.status, status);
  QVERIFY2(run.error.contains(says.toUtf8()), run.error.constData());
  QVERIFY(!QFileInfo::exists(folder_.filePath("out.png")));
}

WINDFALL_SUITE(RenderCliTest)
#include "render_cli.moc"
