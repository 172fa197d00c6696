// Several examples, the tools' numbers, both methods, cancelling and bad input in the real window.
#include <QListWidget>
#include <QPushButton>
#include <QToolButton>

#include "model/document/project_file.h"
#include "model/leaf/region_match.h"
#include "support/leaf_stage.h"
#include "support/small_disk.h"
#include "widgets/fields/choice_field.h"
#include "widgets/fields/number_field.h"
#include "widgets/leaf/leaf_inspector.h"
#include "widgets/leaf/leaf_jobs.h"
#include "widgets/leaf/leaf_pictures.h"
#include "widgets/leaf/leaf_tool_box.h"
#include "widgets/leaf/region_match_view.h"
#include "widgets/leaf/stage_bar.h"
#include "widgets/leaf/tool_options.h"
#include "widgets/leaf/variant_strip.h"
#include "widgets/main_window/jobs_indicator.h"
#include "widgets/main_window/project_files.h"

using namespace windfall;
using namespace windfall::widgets;
using model::Stage;

class LeafExamplesWindow : public QObject, test::LeafStage {
  Q_OBJECT

  model::AssetId other_;
  QTemporaryDir folder_;

  QString at(const QString& name) const { return folder_.filePath(name); }
  void tick(int row) {
    QListWidgetItem* item = leaf_->regionMatch().exampleList()->item(row);
    item->setCheckState(item->checkState() == Qt::Checked ? Qt::Unchecked : Qt::Checked);
  }

 private slots:
  void initTestCase() {
    // The same leaf in autumn.
    model::Leaf red = test::paintedLeaf(QStringLiteral("autumn"));
    QImage photo = test::paintedLeafPhoto();
    red.photo.bytes.clear();
    QBuffer buffer(&red.photo.bytes);
    QVERIFY(buffer.open(QIODevice::WriteOnly));
    const QImage green = photo;
    for (int y = 0; y < photo.height(); ++y) {
      for (int x = 0; x < photo.width(); ++x) {
        const QColor c = green.pixelColor(x, y);
        photo.setPixelColor(x, y,
                            c.blue() < 200 ? QColor(std::min(255, c.green() + 40), c.red() / 2, c.blue() / 2) : c);
      }
    }
    QVERIFY(photo.save(&buffer, "PNG"));
    QVERIFY(open({test::paintedLeaf(), red}));
    other_ = ids_[1];
  }
  void init() {
    remember();
    editor_->window().messages().dismiss();
    pane_->setFocus();
    leaf_->setStage(Stage::Mask);
    QVERIFY(settle());
  }
  void cleanup() {
    QVERIFY(undoneToTheStart());
    leaf_->toolBox().choose(QStringLiteral("hand"));
    QVERIFY(settle());
  }
  void cleanupTestCase() { editor_.reset(); }

  void severalLeavesLendToOneTexture() {
    QTest::keyClick(pane_, Qt::Key_C);
    QVERIFY(settle());
    RegionMatchView& match = leaf_->regionMatch();
    QCOMPARE(match.exampleList()->count(), 2);
    QCOMPARE(match.exampleList()->item(0)->checkState(), Qt::Checked);
    const std::vector<int> alone = match.match();
    tick(1);
    QCOMPARE(shown().examples, (std::vector<model::AssetId>{id_, other_}));
    QVERIFY(settle());
    QCOMPARE(match.example(), other_);
    // Some regions take from the one, some from the other.
    const int own = leaf_->pictures().stages()->grown.regions.count;
    QVERIFY(own > 0);
    QVERIFY(match.match() != alone);
    QVERIFY(shot("leaf_several_examples.png"));
    // A pair by hand with the second leaf.
    const QPointF target = leaf_->pictures().stages()->markers[0];
    drag({target});
    QTest::mouseClick(&match.pane(), Qt::LeftButton, {}, on(match.pane(), target));
    QCOMPARE(shown().regionPairs.size(), std::size_t(1));
    QCOMPARE(shown().regionPairs[0].example, other_);
    QVERIFY(settle());
    // Saved and read again.
    const QString path = at("several.windfall");
    model::Progress progress;
    QVERIFY(model::writeProject(editor_->document().project(), path, progress));
    const auto read = model::readProject(path, progress);
    QVERIFY(read);
    QCOMPARE(read->leaf(id_)->examples, shown().examples);
    QCOMPARE(read->leaf(id_)->regionPairs, shown().regionPairs);
    QVERIFY(read->leaf(id_)->parameters.regions.mix);
    leaf_->variants().countBox()->setValue(1);
    QTest::mouseClick(leaf_->variants().makeButton(), Qt::LeftButton);
    QVERIFY(editor_->settle(120));
    QCOMPARE(shown().variants.size(), std::size_t(1));
    int reds = 0, greens = 0;
    const QImage image = shown().variants[0].image;
    for (int y = 0; y < image.height(); y += 2) {
      for (int x = 0; x < image.width(); x += 2) {
        const QColor c = image.pixelColor(x, y);
        if (c.alpha() < 255) continue;
        reds += c.red() > c.green() + 30;
        greens += c.green() > c.red() + 15;
      }
    }
    QVERIFY2(reds > 100 && greens > 100, qPrintable(QString("%1 %2").arg(reds).arg(greens)));
    leaf_->setStage(Stage::Variants);
    QVERIFY(settle());
    QVERIFY(shot("leaf_mixed_variant.png"));
    // The last tick taken away: itself again.
    leaf_->toolBox().choose(QStringLiteral("link"));
    QVERIFY(settle());
    tick(0);
    tick(1);
    QVERIFY(shown().examples.empty());
    QVERIFY(settle());
  }

  void bothMethodsMakeVariants() {
    leaf_->setStage(Stage::Veins);
    leaf_->variants().countBox()->setValue(1);
    for (const bool guided : {true, false}) {
      model::LeafParameters parameters = shown().parameters;
      parameters.synthesis.guided = guided;
      editor_->document().setLeaf(id_, &model::Leaf::parameters, parameters, model::Aspect::LeafParameters, "Method");
      QTest::mouseClick(leaf_->variants().makeButton(), Qt::LeftButton);
      QVERIFY(editor_->settle(120));
    }
    QCOMPARE(shown().variants.size(), std::size_t(2));
    QVERIFY(shown().variants[0].image != shown().variants[1].image);
    leaf_->setStage(Stage::Variants);
    QVERIFY(settle());
    QVERIFY(shot("leaf_gallery.png"));
  }

  void workIsCancelledInTheMiddle() {
    leaf_->variants().countBox()->setValue(40);
    QTest::mouseClick(leaf_->variants().makeButton(), Qt::LeftButton);
    QVERIFY(!leaf_->variants().makeButton()->isEnabled());
    auto* indicator = editor_->window().findChild<JobsIndicator*>();
    QVERIFY(indicator);
    auto* cancel = indicator->findChild<QToolButton*>();
    QTRY_VERIFY_WITH_TIMEOUT(cancel->isVisible(), 20000);
    // In the middle: something is done, more is left.
    QTRY_VERIFY_WITH_TIMEOUT(!editor_->jobs().running().empty() && editor_->jobs().running().front()->fraction() > 0.05,
                             60000);
    QVERIFY(shot("leaf_working.png"));
    QTest::mouseClick(cancel, Qt::LeftButton);
    QVERIFY(settle());
    QVERIFY(shown().variants.empty());
    QVERIFY(leaf_->variants().makeButton()->isEnabled());
    QCOMPARE(undo().count(), 0);
    QVERIFY(!editor_->window().messages().isError());
  }

  void toolsHaveTheirNumbersAboveTheCanvas() {
    ToolOptions& options = leaf_->toolOptions();
    QTest::keyClick(pane_, Qt::Key_B);
    auto* size = qobject_cast<NumberField*>(options.field(QStringLiteral("size")));
    QVERIFY(size && size->isVisible());
    size->box()->setValue(33);
    QCOMPARE(leaf_->toolBox().current().size(), 33.0);
    QTest::keyClick(pane_, Qt::Key_BracketRight);
    QVERIFY(size->value() > 33);
    QTest::keyClick(pane_, Qt::Key_P);
    QVERIFY(settle());
    auto* width = qobject_cast<NumberField*>(options.field(QStringLiteral("width")));
    auto* order = qobject_cast<ChoiceField*>(options.field(QStringLiteral("order")));
    QVERIFY(width && order);
    width->box()->setValue(7);
    order->box()->setCurrentIndex(3);
    emit order->edited(3, true);
    QVERIFY(shot("leaf_vein_pen.png"));
    drag({{242, 500}, {290, 470}, {330, 455}, {360, 450}});
    QCOMPARE(shown().veins.back().order, 3);
    QVERIFY(std::abs(shown().veins.back().startWidth - 7) < 0.01);
    // The chosen vein's own.
    QTest::keyClick(pane_, Qt::Key_A);
    QVERIFY(options.field(QStringLiteral("startWidth")) == nullptr);
    const QPointF end = shown().veins.back().points.back();
    drag({end});
    auto* start = qobject_cast<NumberField*>(options.field(QStringLiteral("startWidth")));
    auto* own = qobject_cast<ChoiceField*>(options.field(QStringLiteral("order")));
    QVERIFY(start && own);
    QCOMPARE(own->value(), 2);
    start->box()->setValue(11);
    QVERIFY(std::abs(shown().veins.back().startWidth - 11) < 0.01);
    emit own->edited(1, true);
    QCOMPARE(shown().veins.back().order, 2);
    QVERIFY(shot("leaf_vein_numbers.png"));
  }

  void theInspectorShowsTheNumbersOfTheStage() {
    for (const auto& [stage, id] :
         {std::pair(Stage::Veins, "veins.laterals"), std::pair(Stage::Regions, "regions.best"),
          std::pair(Stage::Distance, "costs.veinTissue"), std::pair(Stage::Contour, "epsilon")}) {
      QTest::mouseClick(leaf_->stageBar().chip(stage), Qt::LeftButton);
      NumberField* field = leaf_->numbers().number(QString::fromLatin1(id));
      QVERIFY(field);
      QVERIFY2(!field->visibleRegion().isEmpty(), id);
    }
    QVERIFY(settle());
  }

  void linesOverASmallPhotoAreFine() {
    QVERIFY(test::paintedLeafPhoto({150, 200}).save(at("tiny.png")));
    QVERIFY(leaf_->openFile(at("tiny.png")));
    QTRY_COMPARE_WITH_TIMEOUT(editor_->document().project().leaves.size(), std::size_t(3), 30000);
    leaf_->setStage(Stage::Contour);
    QVERIFY(settle());
    QCOMPARE(pane_->overlay().size(), pane_->base().size() * 5);
    // The line runs where the mask ends: a place on the outline is drawn on.
    const QPointF place = leaf_->pictures().stages()->contour[3] * 5;
    QVERIFY(qAlpha(pane_->overlay().full().pixel(place.toPoint())) > 200);
    QVERIFY(shot("leaf_small_photo.png"));
    undo().undo();
    leaf_->show(id_);
  }

  void markersInOnePlaceAreTold() {
    leaf_->setStage(Stage::Regions);
    QVERIFY(settle());
    const QPointF one = leaf_->pictures().stages()->markers[0];
    editor_->document().setLeaf(id_, &model::Leaf::markers, std::vector<QPointF>(5, one), model::Aspect::LeafMarkers,
                                "Markers");
    QVERIFY(settle());
    QVERIFY2(saidWrong() && said().contains("one place"), qPrintable(said()));
    editor_->document().setLeaf(id_, &model::Leaf::markers, {QPointF(-40, -40)}, model::Aspect::LeafMarkers, "Markers");
    QVERIFY(settle());
    QVERIFY2(saidWrong() && said().contains("no marker"), qPrintable(said()));
  }

  void severalLeavesInOnePhotoBecomeSeveralAssets() {
    QImage sheet(760, 420, QImage::Format_RGB32);
    sheet.fill(QColor(232, 230, 222));
    QPainter painter(&sheet);
    painter.drawImage(20, 20, test::paintedLeafPhoto({280, 373}));
    painter.drawImage(400, 40, test::paintedLeafPhoto({240, 320}));
    painter.end();
    QVERIFY(sheet.save(at("sheet.png")));
    QVERIFY(leaf_->openFile(at("sheet.png")));
    QTRY_COMPARE_WITH_TIMEOUT(editor_->document().project().leaves.size(), std::size_t(3), 30000);
    QVERIFY(settle());
    QVERIFY2(said().contains("2 leaves"), qPrintable(said()));
    QVERIFY(trigger(QStringLiteral("Separate Several Leaves")));
    QTRY_COMPARE_WITH_TIMEOUT(editor_->document().project().leaves.size(), std::size_t(4), 30000);
    QVERIFY(settle());
    const std::vector<model::Leaf>& leaves = editor_->document().project().leaves;
    QVERIFY(!leaves[2].mask.isNull() && !leaves[3].mask.isNull() && leaves[2].mask != leaves[3].mask);
    // Both come from one step, the photo from another.
    undo().undo();
    QCOMPARE(editor_->document().project().leaves.size(), std::size_t(3));
    undo().undo();
    leaf_->show(id_);
  }

  void aVeinPictureDrawnElsewhereIsLoaded() {
    LeafJobs jobs(editor_->document(), editor_->jobs());
    QImage lines(480, 640, QImage::Format_Grayscale8);
    lines.fill(0);
    QPainter painter(&lines);
    painter.setPen(QPen(Qt::white, 5));
    painter.drawLine(240, 544, 240, 60);
    painter.drawLine(240, 400, 360, 320);
    painter.end();
    QVERIFY(lines.save(at("lines.png")));
    jobs.loadVeins(at("lines.png"), id_);
    QTRY_COMPARE_WITH_TIMEOUT(shown().veins.size(), std::size_t(2), 30000);
    QCOMPARE(shown().veins[1].order, 2);
    // One of another size: told, and the veins stay.
    QVERIFY(lines.scaled(100, 100).save(at("small.png")));
    jobs.loadVeins(at("small.png"), id_);
    QTRY_VERIFY_WITH_TIMEOUT(saidWrong(), 30000);
    QCOMPARE(shown().veins.size(), std::size_t(2));
  }

  void aBareMaskTakesColoursOfAnotherLeaf() {
    QImage mask(360, 480, QImage::Format_Grayscale8);
    mask.fill(0);
    QPainter painter(&mask);
    painter.setBrush(Qt::white);
    painter.drawEllipse(60, 40, 240, 400);
    painter.end();
    QVERIFY(mask.save(at("bare.png")));
    QVERIFY(leaf_->openFile(at("bare.png")));
    QTRY_COMPARE_WITH_TIMEOUT(editor_->document().project().leaves.size(), std::size_t(3), 30000);
    QVERIFY(settle());
    const model::AssetId bare = editor_->document().project().leaves.back().id;
    QCOMPARE(leaf_->leaf(), bare);
    model::LeafParameters parameters = shown().parameters;
    editor_->document().setLeaf(bare, &model::Leaf::parameters, parameters, model::Aspect::LeafParameters, "Size");
    leaf_->toolBox().choose(QStringLiteral("link"));
    QVERIFY(settle());
    tick(1);
    tick(2);
    QCOMPARE(editor_->document().project().leaf(bare)->examples, std::vector<model::AssetId>{other_});
    leaf_->variants().countBox()->setValue(1);
    QTest::mouseClick(leaf_->variants().makeButton(), Qt::LeftButton);
    QVERIFY(editor_->settle(60));
    const std::vector<model::Variant>& made = editor_->document().project().leaf(bare)->variants;
    QCOMPARE(made.size(), std::size_t(1));
    const QColor middle = made[0].image.pixelColor(made[0].image.rect().center() + QPoint(20, 0));
    QVERIFY(middle.alpha() == 255 && middle.red() > middle.green() + 30);
    QVERIFY(shot("leaf_bare_mask.png"));
    leaf_->show(id_);
  }

  void badFilesAreOneLineAndNothingIsLost_data() {
    QTest::addColumn<QString>("name");
    for (const char* name : {"garbage.jpg", "one.png", "huge.png", "missing.png"}) QTest::newRow(name) << QString(name);
  }
  void badFilesAreOneLineAndNothingIsLost() {
    QFETCH(QString, name);
    QFile garbage(at("garbage.jpg"));
    QVERIFY(garbage.open(QIODevice::WriteOnly) && garbage.write("no picture") > 0);
    garbage.close();
    QVERIFY(QImage(1, 1, QImage::Format_RGB32).save(at("one.png")));
    if (name == QLatin1String("huge.png")) {
      QImage huge(20000, 20000, QImage::Format_Mono);
      huge.fill(0);
      QVERIFY(huge.save(at("huge.png")));
    }
    QVERIFY(leaf_->openFile(at(name)));
    QTRY_VERIFY_WITH_TIMEOUT(saidWrong(), 30000);
    QVERIFY2(said().contains(name), qPrintable(said()));
    QCOMPARE(editor_->document().project().leaves.size(), std::size_t(2));
    QCOMPARE(undo().count(), 0);
  }

  void aPhotoWithoutALeafIsTold() {
    QImage flat(300, 200, QImage::Format_RGB32);
    flat.fill(QColor(200, 196, 190));
    QVERIFY(flat.save(at("flat.png")));
    QVERIFY(leaf_->openFile(at("flat.png")));
    QTRY_VERIFY_WITH_TIMEOUT(saidWrong() && said().contains("no leaf found"), 30000);
    // The photo is there, so that the mask can be painted by hand.
    QCOMPARE(editor_->document().project().leaves.size(), std::size_t(3));
    QVERIFY(shot("leaf_no_leaf.png"));
    undo().undo();
    leaf_->show(id_);
    QVERIFY(settle());
  }

  void anAtlasThatCannotBeWrittenIsTold() {
    const QVariant last = QSettings().value("atlasFile");
    QSettings().setValue("atlasFile", "/proc/windfall/atlas.png");
    leaf_->variants().countBox()->setValue(1);
    QTest::mouseClick(leaf_->variants().makeButton(), Qt::LeftButton);
    QVERIFY(editor_->settle(60));
    leaf_->exportResult(false);
    QTRY_VERIFY_WITH_TIMEOUT(saidWrong() && said().contains("/proc/windfall"), 30000);
    QSettings().setValue("atlasFile", last);
    QCOMPARE(shown().variants.size(), std::size_t(1));
  }

  void aFullDiskIsToldAndNothingIsHalfWritten() {
    test::SmallDisk disk(16);
    if (!disk.isMounted()) QSKIP("a small disk cannot be mounted here");
    leaf_->variants().countBox()->setValue(1);
    QTest::mouseClick(leaf_->variants().makeButton(), Qt::LeftButton);
    QVERIFY(settle());
    // The atlas.
    const QVariant last = QSettings().value("atlasFile");
    QSettings().setValue("atlasFile", disk.filePath("atlas.png"));
    leaf_->exportResult(false);
    QTRY_VERIFY_WITH_TIMEOUT(saidWrong() && said().contains("atlas"), 30000);
    QVERIFY2(said().contains("No space left"), qPrintable(said()));
    QVERIFY2(disk.isEmpty(), qPrintable(disk.names()));
    QVERIFY(shot("leaf_full_disk.png"));
    QSettings().setValue("atlasFile", last);
    // The project with its photo.
    editor_->window().messages().dismiss();
    QVERIFY(!editor_->window().files().saveTo(disk.filePath("leaf.windfall")));
    QTRY_VERIFY_WITH_TIMEOUT(saidWrong() && said().contains("leaf.windfall"), 30000);
    QVERIFY2(disk.isEmpty(), qPrintable(disk.names()));
    QVERIFY(settle());
  }
};

WINDFALL_SUITE(LeafExamplesWindow)
#include "leaf_examples_window.moc"
