// The leaf workspace in the real window, with real events.
#include <QListWidget>
#include <QPushButton>
#include <QToolButton>

#include "support/leaf_stage.h"
#include "widgets/fields/number_field.h"
#include "widgets/leaf/leaf_inspector.h"
#include "widgets/leaf/leaf_pictures.h"
#include "widgets/leaf/leaf_tool_box.h"
#include "widgets/leaf/stage_bar.h"
#include "widgets/leaf/variant_delegate.h"
#include "widgets/leaf/variant_strip.h"

using namespace windfall;
using namespace windfall::widgets;
using model::Stage;

class LeafWorkspaceTest : public QObject, test::LeafStage {
  Q_OBJECT

 private slots:
  void init() {
    QVERIFY(open());
    leaf_->setStage(Stage::Mask);
    QVERIFY(settle());
    QVERIFY(!leaf_->pictures().mask().isNull());
  }
  void cleanup() { editor_.reset(); }

  void brushStrokeIsOneUndoStep() {
    QTest::keyClick(pane_, Qt::Key_B);
    QCOMPARE(leaf_->toolBox().current().id(), QStringLiteral("brush"));
    leaf_->toolBox().setToolSize(30);
    const QImage automatic = leaf_->pictures().mask();
    QVERIFY(automatic.pixelColor(30, 30).red() < 128);
    drag({{30, 30}, {60, 30}, {90, 30}});
    QVERIFY(!shown().mask.isNull());
    for (int x = 30; x <= 90; x += 10) QCOMPARE(int(shown().mask.constScanLine(30)[x]), 255);
    // Half of the width to each side, and nothing beyond.
    QCOMPARE(int(shown().mask.constScanLine(30 + 12)[60]), 255);
    QVERIFY(shown().mask.constScanLine(30 + 19)[60] < 128);
    QCOMPARE(undo().count(), 1);
    const QImage painted = shown().mask;
    QTest::keyClick(pane_, Qt::Key_Z, Qt::ControlModifier);
    QVERIFY(shown().mask.isNull());
    QCOMPARE(leaf_->pictures().mask(), automatic);
    QTest::keyClick(pane_, Qt::Key_Y, Qt::ControlModifier);
    QCOMPARE(shown().mask, painted);
  }

  void escapeInTheMiddleOfAStrokeLeavesNothing() {
    QTest::keyClick(pane_, Qt::Key_E);
    leaf_->toolBox().setToolSize(60);
    const QImage before = pane_->overlay().full();
    press({{240, 300}, {260, 320}, {240, 340}});
    QVERIFY(pane_->overlay().full() != before);
    QTest::keyClick(pane_, Qt::Key_Escape);
    QCOMPARE(pane_->overlay().full(), before);
    release({240, 340});
    QVERIFY(shown().mask.isNull());
    QCOMPARE(undo().count(), 0);
  }

  void bracketsAndShiftDragChangeTheBrush() {
    QTest::keyClick(pane_, Qt::Key_B);
    leaf_->toolBox().setToolSize(40);
    QTest::keyClick(pane_, Qt::Key_BracketRight);
    QVERIFY(leaf_->toolBox().current().size() > 40);
    QTest::keyClick(pane_, Qt::Key_BracketLeft);
    QVERIFY(std::abs(leaf_->toolBox().current().size() - 40) < 1e-6);
    drag({{200, 300}, {230, 300}}, Qt::ShiftModifier);
    QVERIFY(std::abs(leaf_->toolBox().current().size() - 100) < 6);
    QVERIFY(shown().mask.isNull());
  }

  void lassoTakesAPartOut() {
    QTest::keyClick(pane_, Qt::Key_L);
    drag({{200, 280}, {280, 280}, {280, 360}, {200, 360}}, Qt::ControlModifier);
    QCOMPARE(int(shown().mask.constScanLine(320)[240]), 0);
    QCOMPARE(int(shown().mask.constScanLine(420)[240]), 255);
  }

  void rootIsSetByAClick() {
    QTest::keyClick(pane_, Qt::Key_R);
    QVERIFY(settle());
    QCOMPARE(leaf_->pictures().wanted(), Stage::Contour);
    drag({{240, 540}});
    QVERIFY(shown().root.has_value());
    QVERIFY(QLineF(*shown().root, {240, 540}).length() < 2);
    QVERIFY(settle());
    QCOMPARE(leaf_->stageBar().chip(Stage::Contour)->state(), StageState::Edited);
    drag({{240, 540}}, Qt::ControlModifier);
    QVERIFY(!shown().root.has_value());
  }

  void anotherSeedGrowsOtherVeins() {
    QTest::mouseClick(leaf_->stageBar().chip(Stage::Veins), Qt::LeftButton);
    QVERIFY(settle());
    QCOMPARE(leaf_->stageBar().chip(Stage::Veins)->state(), StageState::Automatic);
    QVERIFY(leaf_->pictures().stages()->veins.size() > 2);
    const model::Veins first = leaf_->pictures().stages()->veins;
    const QImage picture = pane_->overlay().full();
    QTest::mouseClick(leaf_->numbers().seed()->dice(), Qt::LeftButton);
    QVERIFY(shown().parameters.veins.seed != 1);
    QVERIFY(settle());
    QVERIFY(leaf_->pictures().stages()->veins != first);
    QVERIFY(pane_->overlay().full() != picture);
    QCOMPARE(leaf_->stageBar().chip(Stage::Veins)->state(), StageState::Edited);
    QVERIFY(shot("leaf_veins.png"));
  }

  void everyStageHasAPictureOfThePhotosSize() {
    for (const Stage stage :
         {Stage::Mask, Stage::Contour, Stage::Veins, Stage::Distance, Stage::Regions, Stage::Superpixels}) {
      QTest::mouseClick(leaf_->stageBar().chip(stage), Qt::LeftButton);
      QVERIFY(settle());
      QVERIFY2(pane_->overlay().size() == pane_->base().size(), qPrintable(StageBar::title(stage)));
      bool something = false;
      const QImage& full = pane_->overlay().full();
      for (int y = 0; y < full.height() && !something; y += 3) {
        for (int x = 0; x < full.width(); x += 3) something |= qAlpha(full.pixel(x, y)) > 0;
      }
      QVERIFY2(something, qPrintable(StageBar::title(stage)));
    }
    QVERIFY(shot("leaf_superpixels.png"));
  }

  void anEarlierEditMakesLaterStagesOutOfDate() {
    leaf_->setStage(Stage::Regions);
    QVERIFY(settle());
    leaf_->setStage(Stage::Photo);
    QVERIFY(settle());
    leaf_->numbers().laterals()->box()->setValue(3);
    QCOMPARE(leaf_->stageBar().chip(Stage::Regions)->state(), StageState::OutOfDate);
    QVERIFY(leaf_->stageBar().chip(Stage::Contour)->state() != StageState::OutOfDate);
    leaf_->setStage(Stage::Regions);
    QVERIFY(settle());
    QVERIFY(leaf_->stageBar().chip(Stage::Regions)->state() != StageState::OutOfDate);
  }

  void markersComeAndGoByClicks() {
    QTest::keyClick(pane_, Qt::Key_M);
    QVERIFY(settle());
    const std::size_t automatic = leaf_->pictures().stages()->markers.size();
    QVERIFY(shown().markers.empty());
    drag({{242, 120}});
    QCOMPARE(shown().markers.size(), automatic + 1);
    QVERIFY(QLineF(shown().markers.back(), {242, 120}).length() < 2);
    QVERIFY(settle());
    drag({{242, 120}}, Qt::ControlModifier);
    QCOMPARE(shown().markers.size(), automatic);
    QTest::keyClick(pane_, Qt::Key_Z, Qt::ControlModifier);
    QTest::keyClick(pane_, Qt::Key_Z, Qt::ControlModifier);
    QVERIFY(shown().markers.empty());
  }

  void variantsAreMadeKeptAndDeleted() {
    leaf_->variants().countBox()->setValue(3);
    QTest::mouseClick(leaf_->variants().makeButton(), Qt::LeftButton);
    QVERIFY(!leaf_->variants().makeButton()->isEnabled());
    QVERIFY(settle(120));
    QCOMPARE(shown().variants.size(), std::size_t(3));
    QCOMPARE(shown().variants[2].seed, quint64(3));
    QListWidget* list = leaf_->variants().list();
    QCOMPARE(list->count(), 3);
    const QRect heart = VariantDelegate::heartOf(list->visualItemRect(list->item(1)));
    QTest::mouseClick(list->viewport(), Qt::LeftButton, {}, heart.center());
    QVERIFY(!shown().variants[1].keep);
    QSignalSpy opened(&leaf_->variants(), &VariantStrip::opened);
    QCOMPARE(list->itemAt(list->visualItemRect(list->item(2)).center()), list->item(2));
    // Qt's double click is the second press alone.
    QTest::mouseClick(list->viewport(), Qt::LeftButton, {}, list->visualItemRect(list->item(2)).center());
    QTest::mouseDClick(list->viewport(), Qt::LeftButton, {}, list->visualItemRect(list->item(2)).center());
    QCOMPARE(opened.size(), 1);
    QVERIFY(settle());
    QCOMPARE(pane_->overlay().size(), shown().variants[2].image.size());
    QVERIFY(shot("leaf_variants.png"));
    list->setCurrentRow(0);
    list->setFocus();
    QTest::keyClick(list, Qt::Key_Delete);
    QCOMPARE(shown().variants.size(), std::size_t(2));
    QCOMPARE(shown().variants[0].seed, quint64(2));
    for (int i = 0; i < 3; ++i) undo().undo();
    QVERIFY(shown().variants.empty());
    for (int i = 0; i < 3; ++i) undo().redo();
    QCOMPARE(shown().variants.size(), std::size_t(2));
  }

  void wheelZoomsAtThePointer() {
    const QPointF screen(200, 200);
    const QPointF held = pane_->toPhoto(screen);
    const double before = pane_->zoom();
    QWheelEvent wheel(screen, pane_->mapToGlobal(screen), {}, QPoint(0, 240), Qt::NoButton, Qt::NoModifier,
                      Qt::NoScrollPhase, false);
    QApplication::sendEvent(pane_, &wheel);
    QVERIFY(pane_->zoom() > 1.3 * before);
    QVERIFY(QLineF(pane_->toPhoto(screen), held).length() < 1e-6);
    QTest::keyClick(pane_, Qt::Key_1);
    QCOMPARE(pane_->zoom(), 1.0);
    QTest::keyClick(pane_, Qt::Key_2);
    QVERIFY(pane_->isFitted());
  }

  void middleDragAndSpaceDragPan() {
    QTest::keyClick(pane_, Qt::Key_B);
    const QPointF before = pane_->toScreen({0, 0});
    QTest::mousePress(pane_, Qt::MiddleButton, {}, QPoint(300, 300));
    QTest::mouseMove(pane_, QPoint(320, 330));
    QMouseEvent move(QEvent::MouseMove, QPointF(340, 340), pane_->mapToGlobal(QPointF(340, 340)), Qt::NoButton,
                     Qt::MiddleButton, Qt::NoModifier);
    QApplication::sendEvent(pane_, &move);
    QTest::mouseRelease(pane_, Qt::MiddleButton, {}, QPoint(340, 340));
    QCOMPARE((pane_->toScreen({0, 0}) - before).toPoint(), QPoint(40, 40));
    QTest::keyPress(pane_, Qt::Key_Space);
    press({pane_->toPhoto({300, 300}), pane_->toPhoto({260, 260})});
    QTest::mouseRelease(pane_, Qt::LeftButton, {}, QPoint(260, 260));
    QTest::keyRelease(pane_, Qt::Key_Space);
    QVERIFY(QLineF(pane_->toScreen({0, 0}), before).length() < 3);
    QVERIFY(shown().mask.isNull());
  }

  void aPenPaintsByItsPressure() {
    QTest::keyClick(pane_, Qt::Key_B);
    leaf_->toolBox().setToolSize(40);
    const auto send = [&](QEvent::Type type, QPointF photo, double pressure, Qt::MouseButtons buttons) {
      const QPointF local = pane_->toScreen(photo);
      QTabletEvent event(type, QPointingDevice::primaryPointingDevice(), local, pane_->mapToGlobal(local), pressure, 0,
                         0, 0, 0, 0, Qt::NoModifier, Qt::LeftButton, buttons);
      QApplication::sendEvent(pane_, &event);
    };
    send(QEvent::TabletPress, {40, 60}, 0.25, Qt::LeftButton);
    send(QEvent::TabletMove, {80, 60}, 0.25, Qt::LeftButton);
    send(QEvent::TabletRelease, {80, 60}, 0, Qt::NoButton);
    QCOMPARE(int(shown().mask.constScanLine(60)[60]), 255);
    // A quarter of 40: five to each side.
    QCOMPARE(int(shown().mask.constScanLine(63)[60]), 255);
    QCOMPARE(int(shown().mask.constScanLine(68)[60]), 0);
  }
};

WINDFALL_SUITE(LeafWorkspaceTest)
#include "leaf_workspace.moc"
