// What is done to branches in the plant workspace: choosing, pulling, pinning, copying, baking.
#include <QClipboard>
#include <QGuiApplication>
#include <QPushButton>
#include <QtTest>
#include <glm/geometric.hpp>

#include "support/suite.h"
#include "support/workspace_stage.h"
#include "widgets/fields/choice_field.h"
#include "widgets/fields/number_field.h"
#include "widgets/plant/plant_workspace.h"

using namespace windfall;
using namespace windfall::widgets;

class BranchToolsTest : public QObject, test::WorkspaceStage<PlantWorkspace> {
  Q_OBJECT

  const model::AssetId plant_{1};

  const sim::Tree& tree() { return *workspace_->feed().assembly()->sim.trees.front().tree; }
  const model::Plant& plant() { return *document_->project().plant(plant_); }
  const FrameResult& last() { return workspace_->controller().last(); }
  QPoint middleOf(std::size_t link) {
    const LinkCapsule& capsule = workspace_->feed().capsules()[link];
    return view().camera().project((capsule.from + capsule.to) / 2.f, view().size())->toPoint();
  }
  /// A link near the end of a limb that nothing hides.
  std::size_t limbLink() {
    const auto pose = workspace_->feed().restPose();
    std::size_t best = 0;
    for (std::size_t i = 0; i < tree().links.size(); ++i) {
      if (tree().links[i].order != 1) continue;
      const auto hit =
          pick(view().camera().ray(middleOf(i), view().size()), workspace_->feed().capsules(), pose, 0.005f);
      if (hit && hit->link == i) best = i;
    }
    return best;
  }
  void sendMove(QPoint at) {
    QMouseEvent move(QEvent::MouseMove, at, view().mapToGlobal(at), Qt::NoButton, Qt::LeftButton, {});
    QApplication::sendEvent(&view(), &move);
  }
  vec3 tipOf(std::size_t link) { return vec3(last().pose[link] * vec4(workspace_->feed().capsules()[link].to, 1)); }
  void setWind(double speed) {
    field<NumberField>("plant.wind")->setValue(speed);
    emit field<NumberField>("plant.wind")->edited(speed, true);
  }
  void waitSeconds(double seconds) {
    const double until = last().statistics.time + seconds;
    QTRY_VERIFY_WITH_TIMEOUT(last().statistics.time >= until, 60000);
  }

 private slots:
  void initTestCase() { QVERIFY(open({1000, 720})); }
  void cleanupTestCase() { close(); }
  void init() {
    model::Project project = test::saplings(0);
    project.plants[0].leafDensity = 0.2;
    document_->open(project, {});
    QVERIFY(window_->settle());
    setWind(0);
    QVERIFY(window_->settle());
  }

  void boxOrderChainAndChildrenChoose() {
    view().setFocus();
    QTest::keyClick(window_.get(), Qt::Key_B, Qt::ShiftModifier);
    QTest::mousePress(&view(), Qt::LeftButton, {}, QPoint(2, 2));
    sendMove(QPoint(100, 100));
    sendMove(QPoint(view().width() - 3, view().height() - 3));
    QTest::mouseRelease(&view(), Qt::LeftButton, {}, QPoint(view().width() - 3, view().height() - 3));
    QCOMPARE(workspace_->branches().chosenLinks().size(), tree().links.size());

    QTest::keyClick(window_.get(), Qt::Key_W);
    const std::size_t link = limbLink();
    QTest::mouseClick(&view(), Qt::LeftButton, Qt::AltModifier, middleOf(link));
    QTRY_COMPARE(workspace_->branches().chosenLinks(), std::vector<std::size_t>{link});
    view().setFocus();
    QTest::keyClick(&view(), Qt::Key_L);
    const auto branch = workspace_->branches().chosenLinks();
    QVERIFY(branch.size() > 1);
    for (const std::size_t i : branch) QCOMPARE(tree().links[i].chain, tree().links[link].chain);
    QTest::keyClick(&view(), Qt::Key_O);
    const auto order = workspace_->branches().chosenLinks();
    QVERIFY(order.size() > branch.size());
    for (const std::size_t i : order) QCOMPARE(tree().links[i].order, 1);
    workspace_->branches().chooseLinks({0}, false);
    QTest::keyClick(&view(), Qt::Key_K);
    QCOMPARE(workspace_->branches().chosenLinks().size(), tree().links.size());
    QVERIFY(field<InfoField>("branch.frequency") != nullptr);
    QTRY_VERIFY(field<InfoField>("branch.frequency")->value().endsWith("Hz"));
  }

  void valuesAreCopiedAndPastedAndMixedOnesShow() {
    workspace_->branches().chooseLinks({0}, false);
    emit field<NumberField>("link.stiffness")->edited(3, true);
    emit field<NumberField>("link.rayleighBeta")->edited(0.02, true);
    view().setFocus();
    QTest::keyClick(&view(), Qt::Key_C, Qt::ControlModifier);
    QVERIFY(QGuiApplication::clipboard()->text().contains("windfallBranch"));
    const std::size_t link = limbLink();
    workspace_->branches().chooseLinks({0, link}, false);
    QVERIFY(field<NumberField>("link.stiffness")->isMixed());
    workspace_->branches().chooseLinks({link}, false);
    QTest::keyClick(&view(), Qt::Key_V, Qt::ControlModifier);
    QCOMPARE(field<NumberField>("link.stiffness")->value(), 3.0);
    QCOMPARE(tree().links[link].rayleighBeta, 0.02f);
    QCOMPARE(plant().edits.size(), std::size_t{2});
    document_->undoStack().undo();
    QCOMPARE(plant().edits.size(), std::size_t{1});
    QCOMPARE(tree().links[link].stiffnessScale, 1.f);
  }

  void aBranchIsPulledByThePointerAndSwaysBack() {
    const std::size_t link = limbLink();
    const vec3 rest = tipOf(link);
    QTest::keyClick(window_.get(), Qt::Key_H);
    const QPoint from = middleOf(link);
    QTest::mousePress(&view(), Qt::LeftButton, {}, from);
    QVERIFY(workspace_->controller().isPlaying());
    for (int i = 1; i <= 5; ++i) sendMove(from + QPoint(6 * i, 10 * i));
    waitSeconds(1.0);
    const float bent = glm::length(tipOf(link) - rest);
    const double angle = static_cast<double>(last().statistics.largestAngle);
    QVERIFY2(bent > 0.05f, qPrintable(QString::number(double(bent))));
    QVERIFY(angle > 0.01);
    window_->grab().save(test::outputFolder() + "/pull.png");
    QTest::mouseRelease(&view(), Qt::LeftButton, {}, from + QPoint(30, 50));
    waitSeconds(4.0);
    const float back = glm::length(tipOf(link) - rest);
    QVERIFY2(back < 0.4f * bent, qPrintable(QString("%1 of %2").arg(double(back)).arg(double(bent))));
    QVERIFY(!document_->isModified());
    workspace_->controller().pause();
    QVERIFY(window_->settle());
  }

  void aPinnedBranchStandsStillInTheWind() {
    const std::size_t link = limbLink();
    workspace_->branches().chooseLinks({link}, false);
    view().setFocus();
    QTest::keyClick(&view(), Qt::Key_L);
    QTest::keyClick(&view(), Qt::Key_P, Qt::ShiftModifier);
    QVERIFY(field<CheckField>("link.pinned")->value());
    QCOMPARE(plant().edits.size(), workspace_->branches().chosenLinks().size());
    setWind(20);
    workspace_->controller().play();
    waitSeconds(1.5);
    float pinned = 0, free = 0;
    for (std::size_t i = 0; i < last().pose.size(); ++i) {
      const float moved = glm::length(tipOf(i) - workspace_->feed().capsules()[i].to);
      float& most = tree().links[i].chain == tree().links[link].chain ? pinned : free;
      most = std::max(most, moved);
    }
    workspace_->controller().pause();
    QVERIFY(window_->settle());
    window_->grab().save(test::outputFolder() + "/pinned.png");
    QVERIFY2(pinned < 0.01f, qPrintable(QString::number(double(pinned))));
    QVERIFY2(free > 5 * pinned, qPrintable(QString::number(double(free))));
    document_->undoStack().undo();
    QVERIFY(plant().edits.empty());
    QVERIFY(!field<CheckField>("link.pinned")->value());
  }

  void aClipIsBakedPlayedUndoneAndSaved() {
    setWind(10);
    field<NumberField>("clip.length")->setValue(1.5);
    QTest::mouseClick(field<QPushButton>("clip.bake"), Qt::LeftButton);
    QTRY_COMPARE_WITH_TIMEOUT(plant().clips.size(), std::size_t{1}, 60000);
    const model::Clip& clip = plant().clips.front();
    QVERIFY(clip.looping);
    QCOMPARE(clip.length, 1.5);
    QCOMPARE(clip.tracks.size(), tree().links.size());
    auto* choice = field<ChoiceField>("clip.choice");
    QCOMPARE(choice->box()->count(), 2);
    emit choice->edited(1, true);
    QVERIFY(workspace_->controller().playsClip());
    QVERIFY(workspace_->controller().isPlaying());
    QTRY_VERIFY_WITH_TIMEOUT(workspace_->controller().clipTime() > 0.4, 30000);
    workspace_->controller().pause();
    QVERIFY(window_->settle());
    const auto bones = model::poseAt(clip, workspace_->feed().assembly()->plants.at(plant_).geometry->bones,
                                     workspace_->controller().clipTime());
    const int bone = workspace_->feed().assembly()->plants.at(plant_).bodies->boneOfLink.back();
    QVERIFY(glm::length(bones[std::size_t(bone)][3] - last().pose.back()[3]) < 1e-4f);
    window_->grab().save(test::outputFolder() + "/clips.png");
    document_->undoStack().undo();
    QVERIFY(plant().clips.empty());
    QVERIFY(!workspace_->controller().playsClip());
    document_->undoStack().redo();
    QCOMPARE(plant().clips.size(), std::size_t{1});
  }

  void bakingCanBeCancelled() {
    field<NumberField>("clip.length")->setValue(60);
    QTest::mouseClick(field<QPushButton>("clip.bake"), Qt::LeftButton);
    QVERIFY(!jobs_->running().empty());
    jobs_->cancelAll();
    jobs_->waitForAll();
    QVERIFY(plant().clips.empty());
    QVERIFY(!document_->isModified());
  }
};

WINDFALL_SUITE(BranchToolsTest)
#include "branch_tools.moc"
