#include "widgets/plant/plant_workspace.h"

#include <QLineEdit>
#include <QPushButton>
#include <QTreeView>
#include <QtTest>
#include <glm/geometric.hpp>

#include "support/gltf_fixture.h"
#include "support/suite.h"
#include "support/workspace_stage.h"
#include "widgets/fields/choice_field.h"
#include "widgets/fields/number_field.h"
#include "widgets/plant/motion_plot.h"

using namespace windfall;
using namespace windfall::widgets;

class PlantWorkspaceTest : public QObject, test::WorkspaceStage<PlantWorkspace> {
  Q_OBJECT

  const model::AssetId plant_{1};

  /// Where the middle of a link stands on the screen, at rest.
  QPoint screenPlace(std::size_t link) {
    const LinkCapsule& capsule = workspace_->feed().capsules()[link];
    const auto place =
        workspace_->viewport().camera().project((capsule.from + capsule.to) / 2.f, workspace_->viewport().size());
    return place ? place->toPoint() : QPoint(-1, -1);
  }

  /// A link of a limb whose middle nothing else hides.
  std::size_t visibleLimbLink() {
    const auto& capsules = workspace_->feed().capsules();
    const auto pose = workspace_->feed().restPose();
    const auto& links = workspace_->feed().assembly()->sim.trees.front().tree->links;
    for (std::size_t i = 0; i < links.size(); ++i) {
      if (links[i].order != 1) continue;
      const Ray ray = workspace_->viewport().camera().ray(screenPlace(i), workspace_->viewport().size());
      const auto hit = pick(ray, capsules, pose, 0.005f);
      if (hit && links[hit->link].chain == links[i].chain) return i;
    }
    return 0;
  }

  void clickLink(std::size_t link, Qt::KeyboardModifiers modifiers = {}) {
    QTest::mouseClick(&workspace_->viewport(), Qt::LeftButton, modifiers, screenPlace(link));
    QVERIFY(window_->settle());
  }

  const std::map<QString, model::LinkAttributes>& edits() { return document_->project().plant(plant_)->edits; }

 private slots:
  void initTestCase() { QVERIFY(open()); }
  void cleanupTestCase() { close(); }

  void init() {
    model::Project project = test::saplings(0);
    project.scene.leaves.count = 40;
    field<QLineEdit>("branch.search")->clear();
    document_->open(project, {});
    QVERIFY(window_->settle());
  }

  void showsThePlantAndListsItsBranches() {
    QCOMPARE(workspace_->plant(), plant_);
    QVERIFY(workspace_->feed().capsules().size() > 10);
    QVERIFY(workspace_->branches().model().rowCount() > 0);
    const QImage picture = workspace_->viewport().grabFramebuffer();
    QSet<QRgb> colors;
    for (int y = 0; y < picture.height(); y += 3) {
      for (int x = 0; x < picture.width(); x += 3) colors.insert(picture.pixel(x, y));
    }
    QVERIFY2(colors.size() > 100, "the picture is empty");
    window_->grab().save(test::outputFolder() + "/plant_workspace.png");
  }

  void clickInTheViewChoosesTheBranchInBoth() {
    const std::size_t link = visibleLimbLink();
    QVERIFY(link > 0);
    clickLink(link);
    const auto chosen = workspace_->branches().chosenLinks();
    QVERIFY(std::find(chosen.begin(), chosen.end(), link) != chosen.end());
    QCOMPARE(workspace_->branches().chosenBranches().size(), std::size_t{1});
    const auto* list = field<QTreeView>("branch.list");
    QCOMPARE(list->selectionModel()->selectedRows().size(), 1);
    QVERIFY(list->viewport()->rect().intersects(list->visualRect(list->selectionModel()->selectedRows().front())));
    render::View view;
    workspace_->controller().describe(view);
    QCOMPARE(view.highlighted.size(), chosen.size());
    window_->grab().save(test::outputFolder() + "/plant_workspace_chosen.png");

    clickLink(link, Qt::ControlModifier);
    QVERIFY(workspace_->branches().chosenLinks().empty());
  }

  void clickOnTheSkyChoosesNothing() {
    clickLink(visibleLimbLink());
    QVERIFY(!workspace_->branches().chosenLinks().empty());
    QTest::mouseClick(&workspace_->viewport(), Qt::LeftButton, {}, {4, 4});
    QTRY_VERIFY(workspace_->branches().chosenLinks().empty());
  }

  void shiftClickAddsAndMixedValuesShow() {
    const std::size_t link = visibleLimbLink();
    clickLink(link);
    auto* stiffness = field<NumberField>("link.stiffness");
    emit stiffness->edited(3, true);
    clickLink(0, Qt::ShiftModifier);
    QCOMPARE(workspace_->branches().chosenBranches().size(), std::size_t{2});
    QVERIFY(stiffness->isMixed());
    emit stiffness->edited(2, true);
    QVERIFY(!stiffness->isMixed());
    for (const auto& [bone, attributes] : edits()) QCOMPARE(attributes.stiffness, 2.0);
    QCOMPARE(edits().size(), workspace_->branches().chosenLinks().size());
  }

  void typedStiffnessIsOneStepAndComesBackByUndo() {
    clickLink(visibleLimbLink());
    auto* stiffness = field<NumberField>("link.stiffness");
    stiffness->box()->setFocus();
    stiffness->box()->selectAll();
    QTest::keyClicks(stiffness->box(), "4.5");
    QTest::keyClick(stiffness->box(), Qt::Key_Return);
    QCOMPARE(edits().size(), workspace_->branches().chosenLinks().size());
    QCOMPARE(edits().begin()->second.stiffness, 4.5);
    QCOMPARE(document_->undoStack().count(), 1);
    const auto link = workspace_->branches().chosenLinks().front();
    const auto simulated = [&] {
      return workspace_->feed().assembly()->sim.trees.front().tree->links[link].stiffnessScale;
    };
    QCOMPARE(simulated(), 4.5f);
    document_->undoStack().undo();
    QVERIFY(edits().empty());
    QCOMPARE(simulated(), 1.f);
    QCOMPARE(stiffness->value(), 1.0);
    document_->undoStack().redo();
    QCOMPARE(stiffness->value(), 4.5);
  }

  void resetBringsDefaultsBack() {
    clickLink(visibleLimbLink());
    emit field<NumberField>("link.damping")->edited(0.4, true);
    emit field<NumberField>("link.woodDensity")->edited(700, true);
    QVERIFY(!edits().empty());
    QTest::mouseClick(field<QPushButton>("branch.reset"), Qt::LeftButton);
    QVERIFY(edits().empty());
    QCOMPARE(field<NumberField>("link.woodDensity")->value(), 950.0);
  }

  void heavierWoodShowsMoreMass() {
    clickLink(0);
    const QString before = field<InfoField>("branch.wood")->value();
    emit field<NumberField>("link.woodDensity")->edited(1200, true);
    QVERIFY(field<InfoField>("branch.wood")->value() != before);
  }

  void searchFindsABranchByName() {
    const QString name = workspace_->branches().model().branchIndex(3).data().toString();
    auto* search = field<QLineEdit>("branch.search");
    search->setFocus();
    QTest::keyClicks(search, name);
    const auto* list = field<QTreeView>("branch.list");
    const auto matches = list->model()->match(list->model()->index(0, 0), Qt::DisplayRole, name, -1,
                                              Qt::MatchExactly | Qt::MatchRecursive);
    QVERIFY(!matches.isEmpty());
    clickLink(0);  // whatever is clicked is shown, hidden by the search or not
    QCOMPARE(workspace_->branches().chosenBranches(), std::vector<int>{0});
  }

  void anotherSeedGrowsAnotherPlantAndKeepsTheChoice() {
    clickLink(0);
    const auto before = workspace_->feed().capsules().back().to;
    emit field<SeedField>("grower.seed")->edited(7, true);
    QVERIFY(window_->settle());
    QVERIFY(glm::length(workspace_->feed().capsules().back().to - before) > 1e-4f);
    QCOMPARE(workspace_->branches().chosenBranches(), std::vector<int>{0});
  }

  void playMovesTheTipAndPlotsIt() {
    clickLink(visibleLimbLink());
    workspace_->viewport().setFocus();
    QTest::keyClick(window_.get(), Qt::Key_Space);
    QVERIFY(workspace_->controller().isPlaying());
    QTRY_VERIFY(workspace_->motion().sampleCount() > 5);
    QTest::keyClick(window_.get(), Qt::Key_Space);
    QVERIFY(!workspace_->controller().isPlaying());
  }

  void leavesAreHungByTheirBoxes() {
    model::Leaf leaf;
    leaf.name = "Oak";
    const model::AssetId id = document_->addLeaf(leaf);
    auto* box = field<CheckField>(qPrintable(QString("plant.leaf.%1").arg(id.value)));
    QVERIFY(box != nullptr);
    QVERIFY(!box->value());
    QTest::mouseClick(box->box(), Qt::LeftButton);
    QCOMPARE(document_->project().plant(plant_)->leaves, std::vector{id});
    document_->undoStack().undo();
    QVERIFY(!box->value());
  }

  void chosenBranchIsLitUpAndNothingElseChanges() {
    const std::size_t link = visibleLimbLink();
    const QImage before = workspace_->viewport().grabFramebuffer();
    clickLink(link);
    const QImage after = workspace_->viewport().grabFramebuffer();
    QCOMPARE(after.size(), before.size());
    int changed = 0;
    bool isChangedThere = false;
    for (int y = 0; y < after.height(); ++y) {
      for (int x = 0; x < after.width(); ++x) {
        const QRgb a = before.pixel(x, y), b = after.pixel(x, y);
        if (std::abs(qRed(a) - qRed(b)) + std::abs(qGreen(a) - qGreen(b)) + std::abs(qBlue(a) - qBlue(b)) < 24)
          continue;
        ++changed;
        isChangedThere = isChangedThere || (QPoint(x, y) - screenPlace(link)).manhattanLength() < 5;
      }
    }
    QVERIFY(isChangedThere);
    QVERIFY2(changed < after.width() * after.height() / 20, qPrintable(QString::number(changed)));
  }

  void importedFileBecomesAPlantATreeAndIsShown() {
    document_->open({}, {});
    QTemporaryDir folder;
    const QString path = folder.filePath("Twig.glb");
    QFile file(path);
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(test::GltfFixture().glb());
    file.close();
    QVERIFY(!workspace_->openFile(folder.filePath("Twig.txt")));
    QVERIFY(workspace_->openFile(path));
    jobs_->waitForAll();
    QCOMPARE(document_->project().plants.size(), std::size_t{1});
    QCOMPARE(document_->project().plants.front().name, "Twig");
    QCOMPARE(document_->project().scene.trees.size(), std::size_t{1});
    QVERIFY(window_->settle());
    QCOMPARE(workspace_->feed().capsules().size(), std::size_t{2});
    QCOMPARE(field<InfoField>("plant.source")->value(), "Twig.glb");
    document_->undoStack().undo();
    QVERIFY(document_->project().plants.empty());
    QVERIFY(document_->project().scene.trees.empty());
  }

  void brokenFileIsRefusedWithItsName() {
    QTemporaryDir folder;
    const QString path = folder.filePath("Broken.glb");
    QFile file(path);
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write("this is no tree");
    file.close();
    QSignalSpy failed(jobs_.get(), &model::JobRunner::failed);
    QVERIFY(workspace_->openFile(path));
    jobs_->waitForAll();
    QCOMPARE(failed.size(), 1);
    QVERIFY(failed.front().at(0).toString().contains("Broken.glb"));
    QVERIFY(!failed.front().at(1).toString().isEmpty());
    QCOMPARE(document_->project().plants.size(), std::size_t{1});
    QVERIFY(!document_->isModified());
  }

  void viewIsSavedAndComesBack() {
    workspace_->viewport().look(StandardView::Right);
    const QJsonObject view = workspace_->saveView();
    workspace_->viewport().look(StandardView::Front);
    workspace_->restoreView(view);
    QCOMPARE(workspace_->viewport().camera().state().azimuth, 90.0);
  }
};

WINDFALL_SUITE(PlantWorkspaceTest)
#include "plant_workspace.moc"
