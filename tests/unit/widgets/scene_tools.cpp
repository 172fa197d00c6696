#include "widgets/scene/scene_tools.h"

#include <QtTest>

#include "support/suite.h"

using namespace windfall;
using namespace windfall::widgets;

class SceneToolsTest : public QObject, private SceneToolHost {
  Q_OBJECT
  static constexpr QSize kSize{800, 600};

  model::Document& document() override { return *document_; }
  SceneSelection& selection() override { return *selection_; }
  model::AssetId treeAt(const Ray&, float, vec3* place) override {
    if (place != nullptr) *place = {0, 2, 0};
    return under_;
  }
  ViewportEvent event(QPointF position, Qt::KeyboardModifiers modifiers = {}) const {
    return {position, Qt::LeftButton, modifiers, camera_, kSize};
  }
  const model::TreePlacement& tree(model::AssetId id) { return *document_->project().tree(id); }

  std::unique_ptr<model::Document> document_;
  std::unique_ptr<SceneSelection> selection_;
  OrbitCamera camera_;
  model::AssetId first_, second_, under_;

 private slots:
  void init() {
    document_ = std::make_unique<model::Document>();
    selection_ = std::make_unique<SceneSelection>();
    model::Plant plant;
    plant.grower = model::GrowerSettings{};
    const model::AssetId id = document_->addPlant(plant);
    model::TreePlacement placed;
    placed.plant = id;
    first_ = document_->addTree(placed);
    placed.position = {5, 0, 0};
    second_ = document_->addTree(placed);
    document_->undoStack().clear();
    camera_ = OrbitCamera();
    under_ = first_;
  }

  void clicksChooseAddAndToggle() {
    SelectTreesTool tool(*this);
    QVERIFY(!tool.press(event({400, 300})));
    tool.click(event({400, 300}));
    QCOMPARE(selection_->trees(), std::vector{first_});
    under_ = second_;
    tool.click(event({400, 300}, Qt::ShiftModifier));
    QCOMPARE(selection_->trees(), (std::vector{first_, second_}));
    tool.click(event({400, 300}, Qt::ControlModifier));
    QCOMPARE(selection_->trees(), std::vector{first_});
    under_ = {};
    tool.click(event({400, 300}, Qt::ShiftModifier));
    QCOMPARE(selection_->trees(), std::vector{first_});
    tool.click(event({400, 300}));
    QVERIFY(selection_->trees().empty());
  }

  void moveFollowsThePointerOverTheGround() {
    MoveTreesTool tool(*this);
    QVERIFY(tool.press(event({400, 300})));
    for (int x = 400; x <= 500; x += 10) tool.move(event({double(x), 300}));
    tool.release(event({500, 300}));
    const double metres = camera_.pixelSize({0, 2, 0}, kSize) * 100;
    const QVector3D moved = tree(first_).position;
    QVERIFY(std::abs(double(moved.length()) - metres) < 1e-3);
    QCOMPARE(moved.y(), 0.f);
    const auto before = camera_.project({0, 0, 0}, kSize), after = camera_.project({moved.x(), 0, moved.z()}, kSize);
    QVERIFY(after->x() > before->x() + 60);
  }

  void oneDragIsOneUndoStep() {
    MoveTreesTool tool(*this);
    for (int drag = 0; drag < 2; ++drag) {
      tool.press(event({400, 300}));
      for (int i = 1; i < 9; ++i) tool.move(event({400.0 + 10 * i, 300.0 - 3 * i}));
      tool.release(event({480, 276}));
    }
    QCOMPARE(document_->undoStack().count(), 2);
    document_->undoStack().undo();
    document_->undoStack().undo();
    QCOMPARE(tree(first_).position, QVector3D());
  }

  void chosenTreesMoveTogether() {
    selection_->set({first_, second_});
    MoveTreesTool tool(*this);
    tool.press(event({400, 300}));
    tool.move(event({450, 300}));
    tool.release(event({450, 300}));
    QVERIFY(tree(first_).position != QVector3D());
    QCOMPARE(tree(second_).position - tree(first_).position, QVector3D(5, 0, 0));
    QCOMPARE(document_->undoStack().count(), 1);
  }

  void escapeTakesTheDragBack() {
    MoveTreesTool tool(*this);
    tool.press(event({400, 300}));
    tool.move(event({450, 300}));
    tool.cancel();
    tool.move(event({470, 300}));
    QCOMPARE(tree(first_).position, QVector3D());
    QCOMPARE(document_->undoStack().count(), 0);
  }

  void dragBesideTreesIsLeftToTheCamera() {
    under_ = {};
    MoveTreesTool tool(*this);
    QVERIFY(!tool.press(event({400, 300})));
  }

  void turningSnapsWithShift() {
    TurnTreesTool tool(*this);
    QVERIFY(tool.press(event({400, 300})));
    tool.move(event({437, 300}));
    QCOMPARE(tree(first_).heading, 18.5);
    tool.move(event({437, 300}, Qt::ShiftModifier));
    QCOMPARE(tree(first_).heading, 15.0);
    tool.move(event({380, 300}));
    QCOMPARE(tree(first_).heading, 350.0);
    tool.release(event({380, 300}));
    QCOMPARE(document_->undoStack().count(), 1);
  }
};

WINDFALL_SUITE(SceneToolsTest)
#include "scene_tools.moc"
