#include "widgets/scene/scene_workspace.h"

#include <QLabel>
#include <QPushButton>
#include <QToolButton>
#include <QtTest>
#include <glm/geometric.hpp>

#include "support/suite.h"
#include "support/workspace_stage.h"
#include "widgets/fields/choice_field.h"
#include "widgets/fields/dial_field.h"
#include "widgets/fields/number_field.h"
#include "widgets/fields/preset_field.h"

using namespace windfall;
using namespace windfall::widgets;

class SceneWorkspaceTest : public QObject, test::WorkspaceStage<SceneWorkspace> {
  Q_OBJECT

  const std::vector<model::AssetId> trees_{{2}, {3}};

  const sim::Statistics& statistics() { return workspace_->controller().last().statistics; }
  const model::Scene& scene() { return document_->project().scene; }

  static float largestMove(const std::vector<mat4>& a, const std::vector<mat4>& b) {
    float largest = 0;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
      for (int c = 0; c < 4; ++c) largest = std::max(largest, glm::length(a[i][c] - b[i][c]));
    }
    return largest;
  }

  /// The foot of a tree on the screen, a little up its trunk.
  QPoint trunkPlace(std::size_t tree) {
    const TreeSpan& span = workspace_->feed().spans()[tree];
    const LinkCapsule& capsule = workspace_->feed().capsules()[span.firstLink];
    const vec3 middle = (capsule.from + capsule.to) / 2.f;
    const mat4 matrix = workspace_->feed().restPose()[span.firstLink];
    return workspace_->viewport()
        .camera()
        .project(vec3(matrix * vec4(middle, 1)), workspace_->viewport().size())
        ->toPoint();
  }

 private slots:
  void initTestCase() { QVERIFY(open()); }
  void cleanupTestCase() { close(); }

  void init() {
    document_->open(test::saplings(2), {});
    QVERIFY(window_->settle());
  }

  void showsTheSceneAndNamesTheDevices() {
    QCOMPARE(workspace_->feed().spans().size(), std::size_t{2});
    QVERIFY(field<InfoField>("device.name")->value().startsWith("CPU"));
    QVERIFY(!field<InfoField>("device.renderer")->value().isEmpty());
    QCOMPARE(field<QToolButton>("deviceButton")->text(), field<InfoField>("device.name")->value());
    QVERIFY(!document_->isModified());
    window_->grab().save(test::outputFolder() + "/scene_workspace.png");
  }

  void playPauseStepAndReset() {
    const auto rest = pose();
    workspace_->viewport().setFocus();
    QTest::keyClick(window_.get(), Qt::Key_Space);
    QVERIFY(workspace_->controller().isPlaying());
    QTRY_VERIFY_WITH_TIMEOUT(statistics().time > 0.3, 20000);
    QTest::keyClick(window_.get(), Qt::Key_Space);
    QVERIFY(!workspace_->controller().isPlaying());
    QVERIFY(window_->settle());
    const double paused = statistics().time;
    QVERIFY(largestMove(rest, pose()) > 1e-4f);
    QCOMPARE(statistics().time, paused);
    QCOMPARE(document_->project().simulation.time, paused);
    QVERIFY(!document_->isModified());

    QTest::keyClick(window_.get(), Qt::Key_Right);
    QVERIFY(window_->settle());
    QVERIFY(std::abs(statistics().time - paused - double(scene().solver.step)) < 1e-6);

    QTest::keyClick(window_.get(), Qt::Key_Home, Qt::ControlModifier);
    QVERIFY(window_->settle());
    QCOMPARE(statistics().time, 0.0);
    QVERIFY(largestMove(rest, pose()) < 1e-5f);
    QCOMPARE(document_->project().simulation, model::SimulationState());
  }

  void nothingIsDrawnWhileNothingHappens() {
    const int drawn = workspace_->viewport().drawnFrames();
    QTest::qWait(150);
    QCOMPARE(workspace_->viewport().drawnFrames(), drawn);
  }

  void cardsOfLeavesAreSetByHandAndUndone() {
    const auto below = [&] {
      render::View view;
      workspace_->controller().describe(view);
      return view.cardsBelow;
    };
    auto* choice = field<ChoiceField>("detail.cards");
    auto* limit = field<NumberField>("detail.cardsBelow");
    QVERIFY(!choice->toolTip().isEmpty() && !limit->toolTip().isEmpty());
    QCOMPARE(below(), 1.5f);
    limit->box()->setFocus();
    limit->box()->selectAll();
    QTest::keyClicks(limit->box(), "3");
    QTest::keyClick(limit->box(), Qt::Key_Return);
    QCOMPARE(scene().detail.cardsBelow, 3.0);
    QCOMPARE(below(), 3.f);
    choice->box()->setFocus();
    QTest::keyClick(choice->box(), Qt::Key_Down);
    QVERIFY(!scene().detail.cards);
    QCOMPARE(below(), 0.f);
    document_->undoStack().undo();
    QVERIFY(scene().detail.cards);
    QCOMPARE(choice->value(), 0);
    QCOMPARE(below(), 3.f);
    document_->undoStack().undo();
    QCOMPARE(limit->value(), 1.5);
    QCOMPARE(below(), 1.5f);
  }

  void windFieldReachesTheEngineAndUndoes() {
    auto* speed = field<NumberField>("wind.speed");
    QCOMPARE(speed->value(), 10.0);
    speed->box()->setFocus();
    speed->box()->selectAll();
    QTest::keyClicks(speed->box(), "21");
    QTest::keyClick(speed->box(), Qt::Key_Return);
    QCOMPARE(scene().wind.speed, 21.f);
    render::View view;
    workspace_->controller().describe(view);
    QVERIFY(std::abs(glm::length(view.wind) - 21) < 1e-4f);
    document_->undoStack().undo();
    QCOMPARE(speed->value(), 10.0);
    workspace_->controller().describe(view);
    QVERIFY(std::abs(glm::length(view.wind) - 10) < 1e-4f);
  }

  void presetSetsTheWindAtOnceAndKeepsItsDirection() {
    auto* preset = field<PresetField>("wind.preset");
    QVERIFY(preset->isMixed());
    QVERIFY(preset->presets().size() > 2);
    emit field<DialField>("wind.direction")->edited(180, true);
    preset->setValue(3);
    emit preset->edited(3, true);
    QVERIFY(scene().wind.speed != 10);
    QVERIFY(std::abs(scene().wind.direction.z - 1) < 1e-6f);
    QVERIFY(!preset->isMixed());
    QCOMPARE(preset->value(), 3);
    QCOMPARE(field<NumberField>("wind.speed")->value(), double(scene().wind.speed));
    document_->undoStack().undo();
    QCOMPARE(scene().wind.speed, 10.f);
    QVERIFY(preset->isMixed());
  }

  void orbitChangesTheCameraAndIsNoEdit() {
    const model::Camera before = workspace_->viewport().camera().state();
    QTest::mousePress(&workspace_->viewport(), Qt::MiddleButton, {}, {300, 200});
    for (int x = 300; x <= 360; x += 10) QTest::mouseMove(&workspace_->viewport(), {x, 200});
    QTest::mouseRelease(&workspace_->viewport(), Qt::MiddleButton, {}, {360, 200});
    QVERIFY(workspace_->viewport().camera().state().azimuth != before.azimuth);
    QCOMPARE(document_->project().view.camera, workspace_->viewport().camera().state());
    QVERIFY(!document_->isModified());
    QTest::keyClick(&workspace_->viewport(), Qt::Key_1, Qt::KeypadModifier);
    QCOMPARE(workspace_->viewport().camera().state().azimuth, 0.0);
  }

  void wheelZoomsSmoothly() {
    workspace_->viewport().setMotionTime(120);
    const double before = workspace_->viewport().camera().state().distance;
    QWheelEvent wheel({200, 200}, workspace_->viewport().mapToGlobal(QPointF(200, 200)), {}, {0, 240}, Qt::NoButton, {},
                      Qt::NoScrollPhase, false);
    QCoreApplication::sendEvent(&workspace_->viewport(), &wheel);
    QVERIFY(workspace_->viewport().isMoving());
    QVERIFY(workspace_->viewport().cameraGoal().distance < before);
    QTRY_VERIFY(!workspace_->viewport().isMoving());
    QCOMPARE(workspace_->viewport().camera().state().distance, workspace_->viewport().cameraGoal().distance);
  }

  void clickChoosesATreeAndItsFieldsMoveIt() {
    QTest::mouseClick(&workspace_->viewport(), Qt::LeftButton, {}, trunkPlace(1));
    QCOMPARE(workspace_->selection().trees(), std::vector{trees_[1]});
    auto* east = field<NumberField>("tree.x");
    QVERIFY(east->isVisible());
    QCOMPARE(east->value(), 2.0);
    emit east->edited(5, true);
    QCOMPARE(scene().trees[1].position.x(), 5.f);
    QVERIFY(window_->settle());
    QVERIFY(std::abs(pose()[workspace_->feed().spans()[1].firstLink][3].x - 5) < 0.2f);
    window_->grab().save(test::outputFolder() + "/scene_workspace_chosen.png");
  }

  void dragMovesATreeAsOneStep() {
    QTest::keyClick(window_.get(), Qt::Key_G);
    const QPoint from = trunkPlace(0);
    QTest::mousePress(&workspace_->viewport(), Qt::LeftButton, {}, from);
    for (int i = 1; i <= 8; ++i) QTest::mouseMove(&workspace_->viewport(), from + QPoint(-6 * i, 2 * i));
    QTest::mouseRelease(&workspace_->viewport(), Qt::LeftButton, {}, from + QPoint(-48, 16));
    QVERIFY(scene().trees[0].position.x() != -2);
    QCOMPARE(document_->undoStack().count(), 1);
    QVERIFY(window_->settle());
    document_->undoStack().undo();
    QCOMPARE(scene().trees[0].position, QVector3D(-2, 0, 0));
  }

  void duplicateAndDeleteAreOneStepEach() {
    workspace_->selection().set(trees_);
    workspace_->viewport().setFocus();
    QTest::keyClick(&workspace_->viewport(), Qt::Key_D, Qt::ShiftModifier);
    QCOMPARE(scene().trees.size(), std::size_t{4});
    QCOMPARE(workspace_->selection().trees().size(), std::size_t{2});
    QTest::keyClick(&workspace_->viewport(), Qt::Key_Delete);
    QCOMPARE(scene().trees.size(), std::size_t{2});
    document_->undoStack().undo();
    document_->undoStack().undo();
    QCOMPARE(scene().trees.size(), std::size_t{2});
    QVERIFY(window_->settle());
    QCOMPARE(workspace_->feed().spans().size(), std::size_t{2});
  }

  void emptySceneSaysWhatToDo() {
    QSignalSpy problems(&workspace_->controller(), &SimulationController::problem);
    for (const model::AssetId tree : trees_) document_->remove(tree);
    QVERIFY(window_->settle());
    QVERIFY(!workspace_->controller().hasScene());
    const auto* hint = window_->findChild<QLabel*>("canvasHint");
    QVERIFY(hint->isVisible());
    QVERIFY(hint->text().contains("Shift+A"));
    QVERIFY2(problems.isEmpty(), "an empty scene is no problem");
  }

  void simulationIsFoundAgainWhereItStopped() {
    workspace_->viewport().setFocus();
    QTest::keyClick(window_.get(), Qt::Key_Space);
    QTRY_VERIFY_WITH_TIMEOUT(statistics().time > 0.2, 20000);
    QTest::keyClick(window_.get(), Qt::Key_Space);
    QTest::keyClick(window_.get(), Qt::Key_Right);  // stands at the end of a step, not between two
    QVERIFY(window_->settle());
    const auto before = pose();
    const double time = statistics().time;
    QTemporaryDir folder;
    const QString path = folder.filePath("scene.windfall");
    workspace_->beforeSave();
    model::Progress progress;
    QVERIFY(document_->save(path, progress));
    document_->open({}, {});
    QVERIFY(window_->settle());
    QVERIFY(!workspace_->controller().hasScene());
    QVERIFY(document_->load(path, progress));
    QVERIFY(window_->settle());
    QCOMPARE(statistics().time, time);
    QVERIFY(largestMove(before, pose()) < 1e-5f);
  }

  void savingWhilePlayingKeepsTheMoment() {
    workspace_->controller().play();
    QTRY_VERIFY_WITH_TIMEOUT(statistics().time > 0.1, 20000);
    workspace_->beforeSave();
    QVERIFY(!document_->project().simulation.bytes.isEmpty());
    workspace_->deactivate();
    QVERIFY(!workspace_->controller().isPlaying());
  }

  void leafCountChangesLive() {
    emit field<NumberField>("leaves.count")->edited(90, true);
    QVERIFY(window_->settle());
    QCOMPARE(workspace_->controller().last().leafCount, std::size_t{90});
  }

  void everyLeafOfTheTreesIsOneClick() {
    std::size_t sites = 0;
    for (const auto& tree : workspace_->feed().assembly()->sim.trees) sites += tree.tree->sites.size();
    QVERIFY(sites > 100);
    QTest::mouseClick(field<CheckField>("leaves.every")->box(), Qt::LeftButton);
    QVERIFY(window_->settle());
    QCOMPARE(document_->project().scene.leaves.count, model::kEveryLeaf);
    QCOMPARE(workspace_->controller().last().leafCount, sites);
    QVERIFY(!field<NumberField>("leaves.count")->isEnabled());
    document_->undoStack().undo();
    QVERIFY(window_->settle());
    QCOMPARE(workspace_->controller().last().leafCount, std::size_t{60});
    QVERIFY(field<NumberField>("leaves.count")->isEnabled());
  }
};

WINDFALL_SUITE(SceneWorkspaceTest)
#include "scene_workspace.moc"
