// The whole path in the real window: a photo and a tree in, a film in the viewport, a project out and in again.
#include <QListWidget>
#include <QMimeData>
#include <QPushButton>
#include <QToolButton>
#include <QTreeView>
#include <QtTest>

#include "app/editor.h"
#include "model/document/project_file.h"
#include "support/gltf_fixture.h"
#include "support/painted_leaf.h"
#include "support/suite.h"
#include "widgets/fields/number_field.h"
#include "widgets/leaf/image_pane.h"
#include "widgets/leaf/leaf_inspector.h"
#include "widgets/leaf/leaf_pictures.h"
#include "widgets/leaf/leaf_tool_box.h"
#include "widgets/leaf/leaf_workspace.h"
#include "widgets/leaf/variant_strip.h"
#include "widgets/look/look.h"
#include "widgets/plant/plant_workspace.h"
#include "widgets/scene/scene_workspace.h"

using namespace windfall;
using namespace windfall::widgets;

class WholePathTest : public QObject {
  Q_OBJECT

  std::unique_ptr<app::Editor> editor_;

  template <class W>
  W& workspace(const char* id) {
    return *qobject_cast<W*>(editor_->window().workspace(QLatin1String(id)));
  }
  void open(const char* id) {
    editor_->window().openWorkspace(QLatin1String(id));
    QVERIFY(editor_->settle(60));
  }
  void start() {
    editor_ = std::make_unique<app::Editor>();
    editor_->window().resize(1100, 760);
    for (Viewport* viewport :
         {&workspace<PlantWorkspace>("plant").viewport(), &workspace<SceneWorkspace>("scene").viewport()}) {
      viewport->setMotionTime(0);
      viewport->setQuality(render::Quality::Draft);
    }
    editor_->window().show();
    QVERIFY(QTest::qWaitForWindowActive(&editor_->window()));
  }
  void dropFile(const QString& path) {
    QMimeData data;
    data.setUrls({QUrl::fromLocalFile(path)});
    QDragEnterEvent enter(QPoint(400, 400), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(&editor_->window(), &enter);
    QDropEvent drop(QPointF(400, 400), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(&editor_->window(), &drop);
    QVERIFY(editor_->settle(60));
  }
  void click(ImagePane& pane, QPointF photo) {
    QTest::mouseClick(&pane, Qt::LeftButton, {}, pane.toScreen(photo).toPoint());
    QVERIFY(editor_->settle(60));
  }
  /// What undo and redo, and saving, must bring back; the counter of ids never goes back.
  static bool same(const model::Project& a, const model::Project& b) {
    return a.leaves == b.leaves && a.plants == b.plants && a.scene == b.scene;
  }

 private slots:
  void initTestCase() { applyLook(*qApp, Scheme::Dark); }
  void cleanup() { editor_.reset(); }

  void fromPhotoAndTreeToFallingLeavesAndBack() {
    QTemporaryDir folder;
    const QString photo = folder.filePath(QStringLiteral("oak.png"));
    QVERIFY(test::paintedLeafPhoto().save(photo));
    const QString tree = folder.filePath(QStringLiteral("tree.glb"));
    QFile file(tree);
    QVERIFY(file.open(QIODevice::WriteOnly) && file.write(test::GltfFixture().glb()) > 0);
    file.close();
    start();
    model::Document& document = editor_->document();
    const model::Project empty = document.project();

    // A leaf: mask, root, veins, markers, variants.
    dropFile(photo);
    QCOMPARE(document.project().leaves.size(), std::size_t{1});
    const model::AssetId leaf = document.project().leaves.front().id;
    LeafWorkspace& studio = workspace<LeafWorkspace>("leaf");
    open("leaf");
    studio.show(leaf);
    model::LeafParameters small = document.project().leaf(leaf)->parameters;
    small.synthesis.size = 192;
    document.setLeaf(leaf, &model::Leaf::parameters, small, model::Aspect::LeafParameters, QStringLiteral("Size"));
    studio.setStage(model::Stage::Mask);
    QVERIFY(editor_->settle(60));
    ImagePane& pane = studio.pane();
    QTest::keyClick(&pane, Qt::Key_B);
    studio.toolBox().setToolSize(24);
    QTest::mousePress(&pane, Qt::LeftButton, {}, pane.toScreen({40, 40}).toPoint());
    QTest::mouseMove(&pane, pane.toScreen({70, 60}).toPoint());
    QTest::mouseRelease(&pane, Qt::LeftButton, {}, pane.toScreen({70, 60}).toPoint());
    QVERIFY(!document.project().leaf(leaf)->mask.isNull());
    QTest::keyClick(&pane, Qt::Key_Z, Qt::ControlModifier);
    QVERIFY(document.project().leaf(leaf)->mask.isNull());
    QTest::keyClick(&pane, Qt::Key_Y, Qt::ControlModifier);
    QTest::keyClick(&pane, Qt::Key_R);
    click(pane, {240, 540});
    QVERIFY(document.project().leaf(leaf)->root.has_value());
    const quint64 seed = document.project().leaf(leaf)->parameters.veins.seed;
    QTest::mouseClick(studio.numbers().seed()->dice(), Qt::LeftButton);
    QVERIFY(document.project().leaf(leaf)->parameters.veins.seed != seed);
    studio.setStage(model::Stage::Veins);
    QVERIFY(editor_->settle(60));
    QVERIFY(studio.pictures().stages()->veins.size() > 2);
    studio.variants().countBox()->setValue(2);
    QTest::mouseClick(studio.variants().makeButton(), Qt::LeftButton);
    QVERIFY(editor_->settle(120));
    QCOMPARE(document.project().leaf(leaf)->variants.size(), std::size_t{2});

    // A tree: imported, placed, the leaf hung on it, a branch made softer.
    dropFile(tree);
    QCOMPARE(document.project().plants.size(), std::size_t{1});
    const model::AssetId plant = document.project().plants.front().id;
    QCOMPARE(document.project().scene.trees.size(), std::size_t{1});
    QCOMPARE(document.project().plant(plant)->leaves, std::vector<model::AssetId>{leaf});
    open("plant");
    PlantWorkspace& inspector = workspace<PlantWorkspace>("plant");
    inspector.show(plant);
    QVERIFY(editor_->settle(60));
    auto* list = editor_->window().findChild<QTreeView*>(QStringLiteral("branch.list"));
    QVERIFY(list && list->model()->rowCount() > 0);
    QTest::mouseClick(list->viewport(), Qt::LeftButton, {}, list->visualRect(list->model()->index(0, 0)).center());
    QVERIFY(!inspector.branches().chosenLinks().empty());
    auto* stiffness = editor_->window().findChild<NumberField*>(QStringLiteral("link.stiffness"));
    QVERIFY(stiffness);
    emit stiffness->edited(0.5, true);
    QVERIFY(!document.project().plant(plant)->edits.empty());

    // The scene: wind, play, pause.
    open("scene");
    SceneWorkspace& stage = workspace<SceneWorkspace>("scene");
    sim::WindSettings wind = document.project().scene.wind;
    wind.speed = 9;
    document.setScene(&model::Scene::wind, wind, model::Aspect::Wind, QStringLiteral("Wind"));
    stage.viewport().setFocus();
    QTest::keyClick(&editor_->window(), Qt::Key_Space);
    QVERIFY(stage.controller().isPlaying());
    QTRY_VERIFY_WITH_TIMEOUT(stage.controller().last().statistics.time > 0.2, 60000);
    QTest::keyClick(&editor_->window(), Qt::Key_Space);
    QVERIFY(!stage.controller().isPlaying());
    QVERIFY(editor_->settle(60));
    QVERIFY(editor_->window().grab().save(test::outputFolder() + QStringLiteral("/whole_path.png")));

    // All of it taken back, and done again.
    const model::Project end = document.project();
    QUndoStack& undo = document.undoStack();
    while (undo.canUndo()) undo.undo();
    QVERIFY(same(document.project(), empty));
    while (undo.canRedo()) undo.redo();
    QVERIFY(same(document.project(), end));
    QVERIFY(editor_->settle(60));

    // Saved, opened in another editor, the same again; saved once more, the same bytes.
    const QString saved = folder.filePath(QStringLiteral("saved.windfall")),
                  again = folder.filePath(QStringLiteral("again.windfall"));
    model::Progress progress;
    QVERIFY(document.save(saved, progress));
    QVERIFY(!document.isModified());
    start();
    QVERIFY(editor_->document().load(saved, progress));
    QVERIFY(editor_->settle(60));
    QVERIFY(same(editor_->document().project(), end));
    editor_.reset();
    Result<model::Project> first = model::readProject(saved, progress);
    QVERIFY(first);
    QVERIFY(model::writeProject(*first, again, progress));
    QFile one(saved), two(again);
    QVERIFY(one.open(QIODevice::ReadOnly) && two.open(QIODevice::ReadOnly));
    QVERIFY(one.readAll() == two.readAll());
  }
};

WINDFALL_SUITE(WholePathTest)
#include "whole_path.moc"
