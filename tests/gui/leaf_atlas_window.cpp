// Maps, ageing, atlas and species in the real window.
#include <QComboBox>

#include "model/leaf/ageing.h"
#include "model/leaf/maps_picture.h"
#include "support/leaf_stage.h"
#include "widgets/fields/choice_field.h"
#include "widgets/fields/number_field.h"
#include "widgets/fields/preset_field.h"
#include "widgets/leaf/atlas_panel.h"
#include "widgets/leaf/leaf_inspector.h"
#include "widgets/leaf/stage_bar.h"
#include "widgets/leaf/variant_strip.h"

using namespace windfall;
using namespace windfall::widgets;
using model::Stage;

class LeafAtlasWindowTest : public QObject, test::LeafStage {
  Q_OBJECT

  QImage canvas() { return leaf_->pane().overlay().isNull() ? QImage() : leaf_->pane().overlay().full(); }

 private slots:
  void initTestCase() { QStandardPaths::setTestModeEnabled(true); }
  void init() {
    model::Leaf leaf = test::paintedLeaf();
    // Two textures without the time of synthesis: the photo itself, cut out by its mask.
    QImage cut = test::paintedLeafPhoto({240, 320}).convertToFormat(QImage::Format_RGBA8888);
    for (int y = 0; y < cut.height(); ++y) {
      for (int x = 0; x < cut.width(); ++x) {
        const QColor c = cut.pixelColor(x, y);
        if (c.blue() > 180) cut.setPixelColor(x, y, Qt::transparent);
      }
    }
    leaf.variants = {{1, true, cut}, {2, true, cut.mirrored(true, false)}};
    QVERIFY(open({leaf}));
  }
  void cleanup() { editor_.reset(); }

  void mapsAreShownAndFollowTheirNumbers() {
    QTest::mouseClick(leaf_->stageBar().chip(Stage::Maps), Qt::LeftButton);
    QVERIFY(settle());
    QTRY_VERIFY(!canvas().isNull());
    const QImage lit = canvas();
    QVERIFY(shot("maps_lit.png"));
    ChoiceField* kind = leaf_->numbers().mapKind();
    kind->box()->setCurrentIndex(int(model::MapKind::Normal));
    emit kind->edited(int(model::MapKind::Normal), true);
    QTRY_VERIFY_WITH_TIMEOUT(canvas() != lit && leaf_->isSettled(), 20000);
    // A normal map is mostly blue.
    const QColor middle = canvas().pixelColor(canvas().width() / 2 + 30, canvas().height() / 2);
    QVERIFY(middle.blue() > 180);
    QVERIFY(shot("maps_normal.png"));
  }

  void ageingIsPreviewedAndUndone() {
    leaf_->setStage(Stage::Variants);
    QVERIFY(settle());
    const QImage fresh = canvas();
    NumberField* age = leaf_->numbers().age();
    age->box()->setValue(0.9);
    QTRY_COMPARE(shown().parameters.ageing.age, 0.9);
    QTRY_VERIFY_WITH_TIMEOUT(canvas() != fresh && leaf_->isSettled(), 20000);
    const QColor old = canvas().pixelColor(canvas().width() / 2 + 30, canvas().height() / 2);
    QVERIFY(old.red() > old.green());
    QVERIFY(shot("ageing.png"));
    undo().undo();
    QCOMPARE(shown().parameters.ageing.age, 0.0);
    QTRY_VERIFY_WITH_TIMEOUT(canvas() == fresh, 20000);
  }

  void aSpeciesIsOneStepToUndo() {
    const model::LeafParameters before = shown().parameters;
    PresetField* species = leaf_->numbers().species();
    const int maple = species->box()->findText(QStringLiteral("Maple"));
    QVERIFY(maple > 0);
    species->box()->setCurrentIndex(maple);
    emit species->edited(maple, true);
    QCOMPARE(shown().parameters.veins.laterals, 6);
    QCOMPARE(shown().parameters.ageing.redness, 0.9);
    QCOMPARE(shown().parameters.synthesis.size, before.synthesis.size);
    QCOMPARE(species->value(), maple);
    undo().undo();
    QVERIFY(shown().parameters == before);
    QCOMPARE(undo().index(), 0);
  }

  void ownPresetsAreSavedSharedAndImported() {
    QTemporaryDir folder;
    model::LeafParameters own = shown().parameters;
    own.maps.gloss = 0.77;
    editor_->document().setLeaf(id_, &model::Leaf::parameters, own, model::Aspect::LeafParameters, "Gloss");
    LeafInspector& numbers = leaf_->numbers();
    QSignalSpy said(&numbers, &LeafInspector::message);
    numbers.sharePreset(folder.filePath("mine"));
    QVERIFY(QFile::exists(folder.filePath("mine.json")));
    numbers.importPreset(folder.filePath("mine.json"));
    QVERIFY(numbers.species()->box()->findText(shown().name) > 0);
    QFile bad(folder.filePath("bad.json"));
    QVERIFY(bad.open(QIODevice::WriteOnly));
    bad.write("{]");
    bad.close();
    numbers.importPreset(bad.fileName());
    QCOMPARE(said.size(), 3);
    QVERIFY(said[2][1].toBool());
    QVERIFY(said[2][0].toString().startsWith("bad.json: ") && !said[2][0].toString().contains('\n'));
    QVERIFY(model::PresetLibrary().find("leaf", shown().name));
    QVERIFY(model::PresetLibrary().find("leaf", shown().name)->values["maps"].toObject()["gloss"].toDouble() == 0.77);
    model::PresetLibrary library;
    QVERIFY(library.remove("leaf", shown().name));
  }

  void theAtlasIsPreviewedAndItsSettingsUndone() {
    QTest::mouseClick(leaf_->stageBar().chip(Stage::Atlas), Qt::LeftButton);
    QTRY_VERIFY_WITH_TIMEOUT(leaf_->atlas().atlas() != nullptr && leaf_->isSettled(), 60000);
    QVERIFY(leaf_->atlas().isVisible());
    QCOMPARE(leaf_->atlas().atlas()->places.size(), size_t(2));
    QCOMPARE(leaf_->atlas().pane().overlay().size(), QSize(512, 512));
    QVERIFY(shot("atlas.png"));
    leaf_->atlas().packer()->box()->setCurrentIndex(2);
    emit leaf_->atlas().packer()->edited(2, true);
    QCOMPARE(editor_->document().project().atlas.packer, model::AtlasPacker::Unity);
    leaf_->atlas().ground()->setValue(2);
    leaf_->atlas().mip()->setValue(5);
    emit leaf_->atlas().mip()->edited(5, true);
    QVERIFY(shot("atlas_mip5_white.png"));
    QTest::keyClick(&leaf_->atlas().pane(), Qt::Key_Z, Qt::ControlModifier);
    QCOMPARE(editor_->document().project().atlas.packer, model::AtlasPacker::Plain);
    QTRY_VERIFY_WITH_TIMEOUT(leaf_->isSettled(), 60000);
    // One key writes it again where it went last.
    QTemporaryDir folder;
    QSettings().setValue("atlasFile", folder.filePath("leaves.png"));
    QTest::keyClick(&leaf_->atlas().pane(), Qt::Key_E, Qt::ControlModifier);
    QTRY_VERIFY_WITH_TIMEOUT(QFile::exists(folder.filePath("leaves.json")), 60000);
    QVERIFY(QFile::exists(folder.filePath("leaves_normal.png")));
    QSettings().remove("atlasFile");
    QTest::mouseClick(leaf_->stageBar().chip(Stage::Photo), Qt::LeftButton);
    QVERIFY(!leaf_->atlas().isVisible());
  }
};

WINDFALL_SUITE(LeafAtlasWindowTest)
#include "leaf_atlas_window.moc"
