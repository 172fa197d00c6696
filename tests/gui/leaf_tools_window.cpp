// Mask, structure, veins and markers by hand in the real window, with real events; undo leads back to the start.
#include <QPushButton>

#include "support/leaf_stage.h"
#include "widgets/fields/choice_field.h"
#include "widgets/fields/number_field.h"
#include "widgets/leaf/leaf_inspector.h"
#include "widgets/leaf/leaf_pictures.h"
#include "widgets/leaf/leaf_tool_box.h"
#include "widgets/leaf/region_match_view.h"
#include "widgets/leaf/stage_bar.h"

using namespace windfall;
using namespace windfall::widgets;
using model::Stage;

class LeafToolsWindow : public QObject, test::LeafStage {
  Q_OBJECT

  int maskAt(int x, int y) { return leaf_->pictures().mask().constScanLine(y)[x]; }

 private slots:
  void initTestCase() { QVERIFY(open({test::paintedLeaf()}, {1360, 860})); }
  void init() {
    remember();
    pane_->setFocus();
    leaf_->setStage(Stage::Mask);
    QVERIFY(settle());
    leaf_->toolBox().setToolSize(24);
  }
  void cleanup() { QVERIFY(undoneToTheStart()); }
  void cleanupTestCase() { editor_.reset(); }

  void linesFillsAndWholeMaskEdits() {
    QTest::keyClick(pane_, Qt::Key_V);
    QCOMPARE(leaf_->toolBox().current().id(), QStringLiteral("line"));
    drag({{30, 30}, {60, 90}, {150, 30}});
    QCOMPARE(maskAt(90, 30), 255);
    QVERIFY(maskAt(60, 70) < 128);
    drag({{30, 60}, {80, 75}, {150, 62}}, Qt::ShiftModifier);
    QCOMPARE(maskAt(140, 60), 255);
    // A hole, and the fill that closes it.
    QTest::keyClick(pane_, Qt::Key_E);
    click({300, 400});
    QCOMPARE(maskAt(300, 400), 0);
    QTest::keyClick(pane_, Qt::Key_F);
    click({300, 400});
    QVERIFY(settle());
    QCOMPARE(maskAt(300, 400), 255);
    QVERIFY(maskAt(20, 600) < 128);
    QVERIFY(trigger(QStringLiteral("Invert Mask")));
    QVERIFY(settle());
    QCOMPARE(maskAt(300, 400), 0);
    QVERIFY(trigger(QStringLiteral("Invert Mask")));
    QVERIFY(settle());
    const QImage mask = leaf_->pictures().mask();
    QVERIFY(trigger(QStringLiteral("Grow Mask")));
    QVERIFY(settle());
    QVERIFY(leaf_->pictures().mask() != mask);
  }

  void aScribbleRefinesTheMask() {
    QTest::keyClick(pane_, Qt::Key_L);
    drag({{250, 250}, {400, 250}, {400, 420}, {250, 420}, {250, 250}}, Qt::ControlModifier);
    QCOMPARE(maskAt(320, 330), 0);
    QTest::keyClick(pane_, Qt::Key_G);
    drag({{270, 280}, {320, 330}, {340, 390}});
    QVERIFY(settle());
    QCOMPARE(maskAt(320, 330), 255);
    QCOMPARE(maskAt(300, 270), 255);
    QVERIFY(shot("leaf_scribble.png"));
  }

  void aRulerMeasuresTheBlade() {
    QTest::keyClick(pane_, Qt::Key_U);
    leaf_->setStage(Stage::Contour);
    QVERIFY(settle());
    drag({{40, 600}, {100, 610}, {240, 600}});
    QVERIFY(shown().ruler.isSet());
    leaf_->numbers().rulerLength()->box()->setValue(4);
    QVERIFY(std::abs(shown().ruler.metres - 0.04) < 1e-9);
    QVERIFY(settle());
    const model::LeafStages& stages = *leaf_->pictures().stages();
    const double wanted = QLineF(stages.root, stages.tip).length() * 0.04 / 200;
    QVERIFY2(std::abs(stages.bladeLength - wanted) < 1e-3,
             qPrintable(QStringLiteral("%1 for %2").arg(stages.bladeLength).arg(wanted)));
    QVERIFY(shot("leaf_ruler.png"));
  }

  void tipsAndHolesAndNumbersAreLive() {
    QTest::keyClick(pane_, Qt::Key_T);
    QVERIFY(settle());
    click({380, 260});
    QCOMPARE(shown().tips.size(), std::size_t(1));
    click({100, 260}, Qt::ShiftModifier);
    QCOMPARE(shown().tips.size(), std::size_t(2));
    leaf_->setStage(Stage::Veins);
    QVERIFY(settle());
    int mains = 0;
    for (const model::Vein& vein : leaf_->pictures().stages()->veins) mains += vein.order == 1;
    QCOMPARE(mains, 2);
    const std::size_t coarse = leaf_->pictures().stages()->veins.size();
    leaf_->numbers().check(QStringLiteral("veins.micro"))->box()->click();
    QVERIFY(settle());
    QVERIFY(leaf_->pictures().stages()->veins.size() > 2 * coarse);
    QCOMPARE(leaf_->pictures().stages()->computed, std::vector<Stage>{Stage::Veins});
    QVERIFY(shot("leaf_micro_veins.png"));
  }

  void veinsAreDrawnAndEdited() {
    leaf_->setStage(Stage::Veins);
    QTest::keyClick(pane_, Qt::Key_P);
    QVERIFY(settle());
    QVERIFY(shown().veins.empty());
    const std::size_t grown = leaf_->pictures().stages()->veins.size();
    drag({{242, 500}, {290, 470}, {330, 455}, {360, 450}});
    QCOMPARE(shown().veins.size(), grown + 1);
    QVERIFY(shown().veins.back().parent >= 0);
    QVERIFY(settle());
    QCOMPARE(leaf_->stageBar().chip(Stage::Veins)->state(), StageState::Edited);
    QTest::keyClick(pane_, Qt::Key_A);
    const model::Vein drawn = shown().veins.back();
    const QPointF end = drawn.points.back();
    QTest::qWait(450);  // The next press is no double click.
    drag({end, end + QPointF(4, -20), end + QPointF(8, -40)});
    QVERIFY(QLineF(shown().veins.back().points.back(), end + QPointF(8, -40)).length() < 3);
    QVERIFY(shot("leaf_vein_edit.png"));
    const double width = shown().veins.back().startWidth;
    QTest::keyClick(pane_, Qt::Key_Plus);
    QVERIFY(shown().veins.back().startWidth > 1.1 * width);
    QTest::keyClick(pane_, Qt::Key_3, Qt::AltModifier);
    QCOMPARE(shown().veins.back().order, 3);
    const std::size_t points = shown().veins.back().points.size();
    if (points > 2) {
      QTest::keyClick(pane_, Qt::Key_Delete);
      QCOMPARE(shown().veins.back().points.size(), points - 1);
    }
    QTest::keyClick(pane_, Qt::Key_Delete, Qt::ShiftModifier);
    QCOMPARE(shown().veins.size(), grown);
  }

  void fieldsHaveALegend() {
    QTest::mouseClick(leaf_->stageBar().chip(Stage::Distance), Qt::LeftButton);
    QVERIFY(settle());
    QVERIFY(leaf_->stageBar().fieldBox()->isVisible());
    QVERIFY(!pane_->legend().isEmpty());
    QCOMPARE(pane_->legend().ticks.size(), std::size_t(5));
    QVERIFY(shot("leaf_field_structural.png"));
    const QImage first = pane_->overlay().full();
    leaf_->stageBar().setField(model::LeafField::Direction);
    QVERIFY(settle());
    QVERIFY(pane_->overlay().full() != first);
    QVERIFY(shot("leaf_field_direction.png"));
    leaf_->stageBar().setField(model::LeafField::Side);
    QVERIFY(settle());
    QCOMPARE(pane_->legend().swatches.size(), std::size_t(2));
    leaf_->stageBar().setField(model::LeafField::Structural);
    leaf_->setStage(Stage::Photo);
    QVERIFY(settle());
    QVERIFY(pane_->legend().isEmpty());
  }

  void regionsAreMatchedByHand() {
    QTest::keyClick(pane_, Qt::Key_C);
    QVERIFY(settle());
    RegionMatchView& match = leaf_->regionMatch();
    QVERIFY(match.isVisible());
    QVERIFY(match.match().size() > 3);
    QVERIFY(shot("leaf_region_match.png"));
    const model::LeafStages& stages = *leaf_->pictures().stages();
    click(stages.markers[0]);
    const QPointF source = stages.markers.back();
    QTest::mouseClick(&match.pane(), Qt::LeftButton, {}, on(match.pane(), source));
    QCOMPARE(shown().regionPairs.size(), std::size_t(1));
    QVERIFY(settle());
    click(stages.markers[0], Qt::ControlModifier);
    QVERIFY(shown().regionPairs.empty());
    QTest::keyClick(pane_, Qt::Key_H);
    QVERIFY(!match.isVisible());
  }
};

WINDFALL_SUITE(LeafToolsWindow)
#include "leaf_tools_window.moc"
