// Growing in the window with real events: a preset, the age, shaping by hand, rules, and everything undone.
#include <QDialogButtonBox>
#include <QFileDialog>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QTemporaryDir>
#include <QTimer>
#include <QtTest>

#include "support/suite.h"
#include "support/workspace_stage.h"
#include "widgets/fields/choice_field.h"
#include "widgets/fields/number_field.h"
#include "widgets/plant/branch_panel.h"
#include "widgets/plant/crown_editor.h"
#include "widgets/plant/plant_export_dialog.h"
#include "widgets/plant/plant_shaping.h"
#include "widgets/plant/plant_workspace.h"
#include "widgets/plant/rules_editor.h"

using namespace windfall;
using namespace windfall::widgets;

class PlantGrowingTest : public QObject, test::WorkspaceStage<PlantWorkspace> {
  Q_OBJECT

  QTemporaryDir parts_;

  const model::Plant& plant() { return *document_->project().plant(workspace_->plant()); }
  std::size_t links() { return workspace_->feed().capsules().size(); }

  void newPlant(const QString& name) {
    QMenu* menu = window_->findChild<QMenu*>("plant.new");
    QVERIFY(menu != nullptr);
    for (QAction* action : menu->actions()) {
      if (action->text() == name) action->trigger();
    }
    QVERIFY(window_->settle());
  }
  void choose(const char* tool) {
    for (QAction* action : workspace_->shaping().actions()) {
      if (action->objectName() == QStringLiteral("shape.") + tool) action->trigger();
    }
  }
  void type(const char* name, double value) {
    NumberBox* box = field<NumberField>(name)->box();
    box->setFocus();
    box->selectAll();
    QTest::keyClicks(box, QLocale().toString(value));
    QTest::keyClick(box, Qt::Key_Return);
    QVERIFY(window_->settle());
  }

  /// A stout link away from the ground whose middle is seen, and where that stands on the screen.
  std::pair<std::size_t, QPoint> visibleLink(int order) {
    const auto& capsules = workspace_->feed().capsules();
    const auto pose = workspace_->feed().restPose();
    const auto& tree = workspace_->feed().assembly()->sim.trees.front().tree->links;
    Viewport& view = workspace_->viewport();
    for (std::size_t i = 1; i < tree.size(); ++i) {
      const vec3 middle = pose[i] * vec4((capsules[i].from + capsules[i].to) / 2.f, 1);
      if (tree[i].order != order || middle.y < 0.2f) continue;
      const auto place = view.camera().project(middle, view.size());
      if (!place || !view.rect().adjusted(60, 60, -60, -60).contains(place->toPoint())) continue;
      const auto hit = pick(view.camera().ray(*place, view.size()), capsules, pose, 0.004f);
      if (hit && hit->link == i) return {i, place->toPoint()};
    }
    return {0, {}};
  }
  void drag(QPoint from, QPoint to) {
    Viewport* view = &workspace_->viewport();
    QTest::mousePress(view, Qt::LeftButton, {}, from);
    for (int k = 1; k <= 6; ++k) QTest::mouseMove(view, from + (to - from) * k / 6);
    QTest::mouseRelease(view, Qt::LeftButton, {}, to);
    QVERIFY(window_->settle());
  }

 private slots:
  void initTestCase() {
    QVERIFY(open());
    workspace_->shaping().setPartFolder(parts_.path());
  }
  void cleanupTestCase() { close(); }
  void init() {
    document_->open({}, {});
    QVERIFY(window_->settle());
  }

  void aPresetGrowsAgesIsPrunedAndBentAndAllIsUndone() {
    newPlant(QStringLiteral("Bush"));
    QCOMPARE(plant().grower->method, model::GrowMethod::SelfOrganizing);
    const std::size_t grown = links();
    QVERIFY(grown > 500);
    type("grower.age", 4);
    QCOMPARE(plant().grower->age, 4.0);
    const std::size_t young = links();
    QVERIFY(young < grown && young > 10);

    choose("prune");
    const auto [cut, place] = visibleLink(2);
    QVERIFY2(cut > 0, "no limb is seen");
    drag(place, place);
    QCOMPARE(plant().handEdits.size(), std::size_t{1});
    QCOMPARE(plant().handEdits[0].kind, model::HandEditKind::Prune);
    QVERIFY(links() < young);
    const std::size_t pruned = links();

    choose("bend");
    const auto [bent, grip] = visibleLink(2);
    QVERIFY(bent > 0);
    drag(grip, grip + QPoint(45, 20));
    QCOMPARE(plant().handEdits.size(), std::size_t{2});
    QCOMPARE(plant().handEdits[1].kind, model::HandEditKind::Bend);
    QCOMPARE(links(), pruned);
    window_->grab().save(test::outputFolder() + "/plant_growing.png");

    QUndoStack& stack = document_->undoStack();
    while (stack.canUndo()) stack.undo();
    QVERIFY(window_->settle());
    QVERIFY(document_->project().plants.empty());
    QVERIFY(!document_->isModified());
  }

  void branchesAreDrawnThickenedAndSetOn() {
    newPlant(QStringLiteral("Bush"));
    type("grower.age", 3);
    const std::size_t before = links();
    choose("draw-branch");
    const auto [base, place] = visibleLink(1);
    QVERIFY2(base > 0, "no limb is seen");
    drag(place, place + QPoint(70, -60));
    QCOMPARE(plant().handEdits.back().kind, model::HandEditKind::Draw);
    QVERIFY(links() > before);

    choose("thicken");
    const auto [thick, grip] = visibleLink(1);
    drag(grip, grip + QPoint(80, 0));
    QCOMPARE(plant().handEdits.back().kind, model::HandEditKind::Thicken);
    QVERIFY(plant().handEdits.back().factor > 1.4);

    choose("handle");
    const auto [node, handle] = visibleLink(1);
    drag(handle, handle + QPoint(20, 10));
    QCOMPARE(plant().handEdits.back().kind, model::HandEditKind::Move);

    // A branch of this plant becomes a part and is set on again elsewhere.
    const auto [kept, unused] = visibleLink(2);
    workspace_->branches().clickLink(kept, {});
    workspace_->shaping().keepPart();
    QCOMPARE(workspace_->shaping().library().parts().size(), std::size_t{1});
    const std::size_t bare = links();
    choose("graft");
    const auto [onto, spot] = visibleLink(1);
    drag(spot, spot + QPoint(-40, -50));
    QCOMPARE(plant().handEdits.back().kind, model::HandEditKind::Graft);
    QVERIFY(links() > bare);
    document_->undoStack().undo();
    QVERIFY(window_->settle());
    QCOMPARE(links(), bare);
  }

  void rulesAreMarkedWhereTheyAreWrong() {
    newPlant(QStringLiteral("Herb"));
    const std::size_t before = links();
    RulesEditor* editor = field<RulesEditor>("rules.text");
    QVERIFY(editor != nullptr && editor->problem().isEmpty());
    editor->text()->setFocus();
    editor->text()->selectAll();
    QTest::keyClicks(editor->text(), "axiom: F");
    QTest::keyClick(editor->text(), Qt::Key_Return);
    QTest::keyClicks(editor->text(), "F -> F[+F");
    QCOMPARE(editor->markedLine(), 2);
    QCOMPARE(editor->problem(), QStringLiteral("2:7: '[' is never closed"));
    QTest::keyClicks(editor->text(), "]F");
    QCOMPARE(editor->markedLine(), 0);
    QTRY_VERIFY(plant().grower->lSystem.rules.endsWith(QLatin1String("F[+F]F")));
    QVERIFY(window_->settle());
    QVERIFY(links() != before);
  }

  void aPlantIsExportedThroughTheDialogs() {
    newPlant(QStringLiteral("Herb"));
    const QString path = parts_.filePath("herb.glb");
    // Two dialogs in turn: where to, and how.
    bool named = false, chosen = false;
    QTimer answers;
    connect(&answers, &QTimer::timeout, this, [&] {
      QWidget* dialog = QApplication::activeModalWidget();
      if (auto* files = qobject_cast<QFileDialog*>(dialog); files != nullptr && !named) {
        named = true;
        auto* name = files->findChild<QLineEdit*>("fileNameEdit");
        name->setText(path);
        QTest::keyClick(name, Qt::Key_Return);
      } else if (auto* settings = qobject_cast<PlantExportDialog*>(dialog); settings != nullptr && !chosen) {
        chosen = true;
        auto* leaves = settings->findChild<ChoiceField*>("export.leaves");
        leaves->box()->setFocus();
        QTest::keyClick(leaves->box(), Qt::Key_Down);  // from one mesh to an object each
        settings->grab().save(test::outputFolder() + "/plant_export_dialog.png");
        QTest::mouseClick(settings->findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Ok), Qt::LeftButton);
      }
    });
    answers.start(20);
    workspace_->exportResult(false);
    answers.stop();
    QVERIFY(named && chosen);
    QTRY_VERIFY(QFileInfo::exists(path));
    QFile file(path);
    QVERIFY(file.open(QIODevice::ReadOnly));
    const QByteArray bytes = file.readAll();
    QVERIFY(bytes.startsWith("glTF"));
    QVERIFY2(bytes.contains("\"leaf.0\""), "leaves are objects of their own");
  }

  void aCrownIsDrawn() {
    newPlant(QStringLiteral("Dead tree"));
    CrownEditor* crown = field<CrownEditor>("crown.outline");
    QVERIFY(crown != nullptr);
    const QPoint widest = crown->toWidget(crown->points()[2]).toPoint();
    QTest::mousePress(crown, Qt::LeftButton, {}, widest);
    QTest::mouseMove(crown, widest - QPoint(30, 0));
    QTest::mouseRelease(crown, Qt::LeftButton, {}, widest - QPoint(30, 0));
    QVERIFY(window_->settle());
    QVERIFY(plant().grower->colonization.crown.profile.size() >= 4);
    document_->undoStack().undo();
    QVERIFY(plant().grower->colonization.crown.profile.empty());
    QVERIFY(window_->settle());
  }
};

WINDFALL_SUITE(PlantGrowingTest)
#include "plant_growing.moc"
