// Importing a skeleton, choosing what a branch is, looking at its data, all with undo.
#include <QPushButton>
#include <QTemporaryDir>
#include <QtTest>

#include "model/plant/prim_format.h"
#include "support/skeleton_data.h"
#include "support/suite.h"
#include "support/workspace_stage.h"
#include "widgets/fields/choice_field.h"
#include "widgets/fields/number_field.h"
#include "widgets/plant/data_legend.h"
#include "widgets/plant/plant_shaping.h"
#include "widgets/plant/plant_workspace.h"
#include "widgets/plant/surface_panel.h"

using namespace windfall;
using namespace windfall::widgets;

class PlantSurfacePanelTest : public QObject, test::WorkspaceStage<PlantWorkspace> {
  Q_OBJECT

  QTemporaryDir folder_;

  const model::Plant& plant() { return document_->project().plants.front(); }
  std::size_t branches() { return workspace_->feed().assembly()->plants.at(plant().id).bodies->branches.size(); }
  QString fork(const QString& name, float water) {
    // A short straight way and a long one aside.
    model::SkeletonGraph graph;
    graph.segments = {test::segment({0, 0, 0}, {0, 1, 0}, 0.05f, -1), test::segment({0, 1, 0}, {0, 1.5f, 0}, 0.05f, 0),
                      test::segment({0, 1, 0}, {0.6f, 1.1f, 0}, 0.03f, 0),
                      test::segment({0.6f, 1.1f, 0}, {1.2f, 1.4f, 0}, 0.02f, 2)};
    for (model::Segment& s : graph.segments) s.state = {water, 0.5f, 1};
    QFile file(folder_.filePath(name));
    if (file.open(QIODevice::WriteOnly)) file.write(*model::writePrim(graph, 4));
    return file.fileName();
  }
  /// Pixels that are much bluer than red.
  int bluePixels() {
    const QImage picture = workspace_->viewport().grabFramebuffer().convertToFormat(QImage::Format_RGB32);
    int count = 0;
    for (int y = picture.height() / 4; y < picture.height(); ++y) {
      for (int x = 0; x < picture.width(); ++x) {
        const QRgb p = picture.pixel(x, y);
        count += qBlue(p) > 2 * qRed(p) + 40 && qBlue(p) > qGreen(p) + 40;
      }
    }
    return count;
  }

 private slots:
  void initTestCase() {
    QVERIFY(open());
    QVERIFY(workspace_->openFile(fork("fork.prim", 1)));
    QVERIFY(QTest::qWaitFor([this] { return document_->project().plants.size() == 1; }, 10'000));
    QVERIFY(window_->settle());
  }
  void cleanupTestCase() { close(); }

  void branchesFollowTheRule() {
    const auto trunk = [this] {
      return workspace_->feed().assembly()->plants.at(plant().id).bodies->branches[0].bones;
    };
    QCOMPARE(branches(), std::size_t{2});
    const std::vector<int> before = trunk();
    auto* rule = field<ChoiceField>("chains.rule");
    QVERIFY(rule != nullptr);
    emit rule->edited(0, true);
    QVERIFY(window_->settle());
    QCOMPARE(plant().surface.chains.rule, model::ChainRule::Longest);
    QVERIFY(trunk() != before);
    QVERIFY(!field<NumberField>("chains.angle")->isVisibleTo(window_.get()));
    document_->undoStack().undo();
    QVERIFY(window_->settle());
    QCOMPARE(plant().surface.chains.rule, model::ChainRule::Score);
    QCOMPARE(trunk(), before);
    QCOMPARE(rule->value(), 1);
  }

  void waterShowsInColours() {
    const int before = bluePixels();
    workspace_->surface().setData(model::PlantData::Water);
    QVERIFY(window_->settle());
    QVERIFY2(bluePixels() > before + 100, qPrintable(QString::number(bluePixels())));
    QVERIFY(field<DataLegend>("plant.legend")->isVisibleTo(window_.get()));
    QVERIFY(!field<DataLegend>("plant.legend")->accessibleName().isEmpty());
    // What is looked at is no edit, and is kept with the view.
    QCOMPARE(workspace_->saveView()["data"].toInt(), 1);
    workspace_->surface().setData(model::PlantData::None);
    QVERIFY(window_->settle());
    QVERIFY(bluePixels() < before + 100);
  }

  void scaleIsUndone() {
    emit field<NumberField>("surface.scale")->edited(2, true);
    QVERIFY(window_->settle());
    QCOMPARE(plant().surface.scale, 2.0);
    const auto& links = workspace_->feed().assembly()->sim.trees.front().tree->links;
    QVERIFY(std::abs(links[0].length - 2) < 1e-5f);
    document_->undoStack().undo();
    QCOMPARE(plant().surface.scale, 1.0);
    QVERIFY(window_->settle());
  }

  void aChangedFileIsOfferedAgain() {
    const int edits = document_->undoStack().count();
    auto* again = field<QPushButton>("plant.reload");
    QVERIFY(!again->isVisibleTo(window_.get()));
    emit field<ChoiceField>("surface.bark")->edited(3, true);
    fork("fork.prim", 0.1f);
    QVERIFY(QTest::qWaitFor([&] { return again->isVisibleTo(window_.get()); }, 10'000));
    const model::SourceFile before = plant().file;
    QTest::mouseClick(again, Qt::LeftButton);
    QVERIFY(QTest::qWaitFor([&] { return plant().file.bytes != before.bytes; }, 10'000));
    QVERIFY(!again->isVisibleTo(window_.get()));
    QCOMPARE(plant().surface.bark, model::BarkKind::Pine);
    QVERIFY(document_->undoStack().count() > edits);
    QVERIFY(window_->settle());
  }

  void aSkeletonIsPrunedInTheViewport() {
    emit field<NumberField>("surface.scale")->edited(2, true);
    QVERIFY(window_->settle());
    const auto links = [this] { return workspace_->feed().capsules().size(); };
    QCOMPARE(links(), std::size_t{4});
    for (QAction* action : workspace_->shaping().actions()) {
      QVERIFY(action->isEnabled());
      if (action->objectName() == QLatin1String("shape.prune")) action->trigger();
    }
    // The outer half of the long way aside.
    Viewport& view = workspace_->viewport();
    const auto place = view.camera().project(2.f * vec3(0.9f, 1.25f, 0), view.size());
    QVERIFY(place.has_value());
    QTest::mouseClick(&view, Qt::LeftButton, {}, place->toPoint());
    QVERIFY(window_->settle());
    QCOMPARE(plant().handEdits.size(), std::size_t{1});
    QVERIFY(std::abs(plant().handEdits[0].place.x() - 1.2f) < 1e-4f);
    window_->grab().save(test::outputFolder() + "/plant_pruned.png");
    QCOMPARE(field<InfoField>("shape.edits")->value(), QStringLiteral("1"));
    document_->undoStack().undo();
    document_->undoStack().undo();
    QVERIFY(window_->settle());
    QVERIFY(plant().handEdits.empty());
    QCOMPARE(links(), std::size_t{4});
  }
};

WINDFALL_SUITE(PlantSurfacePanelTest)
#include "plant_surface_panel.moc"
