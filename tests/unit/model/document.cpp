// Every edit is one undo step, one typed change, and leaves a whole project behind.
#include "model/document/document.h"

#include <QSignalSpy>
#include <QtTest>

#include "model/document/mask_command.h"
#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;

namespace {

Leaf leafNamed(const QString& name) {
  Leaf leaf;
  leaf.name = name;
  return leaf;
}

QImage plainMask(QSize size, int value) {
  QImage mask(size, QImage::Format_Grayscale8);
  mask.fill(QColor(value, value, value));
  return mask;
}

/// The aspects announced while `edit` ran.
template <class Edit>
std::vector<Aspect> announced(Document& document, Edit edit) {
  std::vector<Aspect> aspects;
  const auto connection =
      QObject::connect(&document, &Document::changed, [&](const Change& change) { aspects.push_back(change.aspect); });
  edit();
  QObject::disconnect(connection);
  return aspects;
}

}  // namespace

class DocumentTest : public QObject {
  Q_OBJECT
 private slots:
  void aPropertyEditIsOneStepAndOneChange();
  void stepsOfADragMergeAndDropOutAtTheStart();
  void editsOfOtherThingsDoNotMerge();
  void settingTheSameValueKeepsTheRedoHistory();
  void modifiedMeansTheStackIsNotClean();
  void editsDuringASaveStayUnsaved();
  void viewAndSimulationAreNoEdits();
  void namesAreMadeUnique();
  void idsAreNeverUsedAgain();
  void aDuplicateEqualsItsOriginal();
  void removingALeafTakesItOffItsPlants();
  void removingAPlantTakesItsTreesAndUndoPutsThemBackInPlace();
  void referencesThatLeadNowhereAreRefused();
  void aStrokeKeepsOnlyTheTilesThatDiffer();
  void theFirstStrokeOnAnAutomaticMaskCanBeUndone();
};

void DocumentTest::aPropertyEditIsOneStepAndOneChange() {
  Document document;
  const AssetId id = document.addLeaf(leafNamed("Oak"));
  const auto aspects = announced(
      document, [&] { document.setLeaf(id, &Leaf::bladeLength, 0.12, Aspect::LeafParameters, "Blade length"); });
  QCOMPARE(aspects, std::vector<Aspect>{Aspect::LeafParameters});
  QCOMPARE(document.project().leaf(id)->bladeLength, 0.12);
  QCOMPARE(document.undoStack().undoText(), QString("Blade length"));
  document.undoStack().undo();
  QCOMPARE(document.project().leaf(id)->bladeLength, 0.08);
}

void DocumentTest::stepsOfADragMergeAndDropOutAtTheStart() {
  Document document;
  sim::WindSettings wind;
  for (int i = 1; i <= 20; ++i) {
    wind.speed = 5 + 0.1f * static_cast<float>(i);
    document.setScene(&Scene::wind, wind, Aspect::Wind, "Wind speed", "drag 1");
  }
  QCOMPARE(document.undoStack().count(), 1);
  document.setScene(&Scene::wind, sim::WindSettings{}, Aspect::Wind, "Wind speed", "drag 1");
  QCOMPARE(document.undoStack().count(), 0);
  QVERIFY(!document.isModified());
}

void DocumentTest::editsOfOtherThingsDoNotMerge() {
  Document document;
  const AssetId one = document.addLeaf(leafNamed("A")), two = document.addLeaf(leafNamed("B"));
  const int before = document.undoStack().count();
  document.setLeaf(one, &Leaf::bladeLength, 0.1, Aspect::LeafParameters, "Blade length", "drag");
  document.setLeaf(two, &Leaf::bladeLength, 0.1, Aspect::LeafParameters, "Blade length", "drag");
  document.setScene(&Scene::seed, quint64(7), Aspect::FallingLeaves, "Seed", "drag");
  document.setScene(&Scene::seed, quint64(8), Aspect::FallingLeaves, "Seed", "another drag");
  document.setScene(&Scene::seed, quint64(9), Aspect::FallingLeaves, "Seed");
  document.setScene(&Scene::seed, quint64(10), Aspect::FallingLeaves, "Seed");
  QCOMPARE(document.undoStack().count(), before + 6);
}

void DocumentTest::settingTheSameValueKeepsTheRedoHistory() {
  Document document;
  document.setScene(&Scene::seed, quint64(7), Aspect::FallingLeaves, "Seed");
  document.undoStack().undo();
  document.setScene(&Scene::seed, quint64(1), Aspect::FallingLeaves, "Seed");
  QVERIFY(document.undoStack().canRedo());
}

void DocumentTest::modifiedMeansTheStackIsNotClean() {
  Document document;
  QSignalSpy modified(&document, &Document::modifiedChanged);
  document.setScene(&Scene::seed, quint64(7), Aspect::FallingLeaves, "Seed");
  QVERIFY(document.isModified());
  document.undoStack().undo();
  QVERIFY(!document.isModified());
  QCOMPARE(modified.count(), 2);
  document.undoStack().redo();
  document.open(Project{}, "x.windfall");
  QVERIFY(!document.isModified());
  QVERIFY(!document.undoStack().canUndo());
  QCOMPARE(document.path(), QString("x.windfall"));
}

void DocumentTest::editsDuringASaveStayUnsaved() {
  Document document;
  document.setScene(&Scene::seed, quint64(7), Aspect::FallingLeaves, "Seed");
  const quint64 copied = document.revision();
  document.setView({"plant", {}, {}});
  document.undoStack().undo();
  document.setScene(&Scene::seed, quint64(8), Aspect::FallingLeaves, "Seed");
  document.markSaved("x.windfall", copied);
  QVERIFY(document.isModified());
  QCOMPARE(document.path(), QString("x.windfall"));
  document.markSaved("x.windfall", document.revision());
  QVERIFY(!document.isModified());
}

void DocumentTest::viewAndSimulationAreNoEdits() {
  Document document;
  ViewState view;
  view.camera.distance = 30;
  SimulationState state{2.5, "bytes"};
  const auto aspects = announced(document, [&] {
    document.setView(view);
    document.setSimulation(state);
    document.setView(view);
  });
  QCOMPARE(aspects, (std::vector<Aspect>{Aspect::View, Aspect::Simulation}));
  QVERIFY(!document.isModified());
  QCOMPARE(document.project().view, view);
}

void DocumentTest::namesAreMadeUnique() {
  Document document;
  const AssetId first = document.addLeaf(leafNamed("Oak"));
  const AssetId second = document.addLeaf(leafNamed("Oak"));
  const AssetId third = document.duplicate(second);
  const AssetId unnamed = document.addLeaf(leafNamed("  "));
  Plant plant;
  plant.name = "Oak";
  const AssetId other = document.addPlant(plant);
  QCOMPARE(document.project().leaf(first)->name, QString("Oak"));
  QCOMPARE(document.project().leaf(second)->name, QString("Oak 2"));
  QCOMPARE(document.project().leaf(third)->name, QString("Oak 3"));
  QCOMPARE(document.project().leaf(unnamed)->name, QString("Leaf"));
  QCOMPARE(document.project().plant(other)->name, QString("Oak"));
  document.rename(third, "Oak");
  QCOMPARE(document.project().leaf(third)->name, QString("Oak 3"));
  document.rename(third, "  Birch  ");
  QCOMPARE(document.project().leaf(third)->name, QString("Birch"));
  document.undoStack().undo();
  QCOMPARE(document.project().leaf(third)->name, QString("Oak 3"));
}

void DocumentTest::idsAreNeverUsedAgain() {
  Document document;
  const Project start = document.project();
  const AssetId first = document.addLeaf(leafNamed("A"));
  document.undoStack().undo();
  QCOMPARE(document.project(), start);
  const AssetId second = document.addLeaf(leafNamed("B"));
  QVERIFY(second.value > first.value);
  document.remove(second);
  const AssetId third = document.addLeaf(leafNamed("C"));
  QVERIFY(third.value > second.value);
  QVERIFY(document.project().nextId > third.value);
}

void DocumentTest::aDuplicateEqualsItsOriginal() {
  Document document;
  Plant plant;
  plant.name = "Birch";
  plant.grower = GrowerSettings{};
  plant.edits["trunk"].stiffness = 3;
  const AssetId original = document.addPlant(plant);
  const AssetId last = document.addPlant(plant);
  const AssetId copy = document.duplicate(original);
  QCOMPARE(document.project().plants[1].id, copy);
  QCOMPARE(document.project().plants[2].id, last);
  Plant same = *document.project().plant(copy);
  same.id = original;
  same.name = "Birch";
  QCOMPARE(same, *document.project().plant(original));
}

void DocumentTest::removingALeafTakesItOffItsPlants() {
  Document document;
  const AssetId leaf = document.addLeaf(leafNamed("Oak")), other = document.addLeaf(leafNamed("Birch"));
  Plant plant;
  plant.leaves = {leaf, other};
  const AssetId wearer = document.addPlant(plant);
  const Project before = document.project();
  const auto aspects = announced(document, [&] { document.remove(leaf); });
  QCOMPARE(aspects, (std::vector<Aspect>{Aspect::Assets, Aspect::PlantLeaves}));
  QCOMPARE(document.project().plant(wearer)->leaves, std::vector<AssetId>{other});
  document.undoStack().undo();
  QCOMPARE(document.project(), before);
}

void DocumentTest::removingAPlantTakesItsTreesAndUndoPutsThemBackInPlace() {
  Document document;
  const AssetId oak = document.addPlant(Plant{}), birch = document.addPlant(Plant{});
  for (int i = 0; i < 6; ++i) {
    TreePlacement tree;
    tree.plant = i % 2 ? oak : birch;
    document.addTree(tree);
  }
  const Project before = document.project();
  document.remove(oak);
  QCOMPARE(document.project().plants.size(), size_t(1));
  QCOMPARE(document.project().scene.trees.size(), size_t(3));
  document.undoStack().undo();
  QCOMPARE(document.project(), before);
  const AssetId tree = before.scene.trees[2].id;
  document.remove(tree);
  QVERIFY(!document.project().tree(tree));
  QCOMPARE(document.project().scene.trees.size(), size_t(5));
  document.undoStack().undo();
  QCOMPARE(document.project(), before);
}

void DocumentTest::referencesThatLeadNowhereAreRefused() {
  Document document;
  TreePlacement tree;
  tree.plant = {77};
  QVERIFY(!document.addTree(tree));
  Plant plant;
  plant.leaves = {{77}};
  const AssetId id = document.addPlant(plant);
  QVERIFY(document.project().plant(id)->leaves.empty());
  document.setPlant(id, &Plant::leaves, {{78}}, Aspect::PlantLeaves, "Leaves");
  QVERIFY(document.project().plant(id)->leaves.empty());
  tree.plant = id;
  const AssetId placed = document.addTree(tree);
  document.setTree(placed, &TreePlacement::plant, AssetId{99}, "Plant");
  QCOMPARE(document.project().tree(placed)->plant, id);
  document.remove({1234});
  document.rename({1234}, "Nobody");
  QCOMPARE(document.undoStack().count(), 2);
}

void DocumentTest::aStrokeKeepsOnlyTheTilesThatDiffer() {
  Document document;
  Leaf leaf = leafNamed("Oak");
  leaf.mask = plainMask({200, 150}, 0);
  const AssetId id = document.addLeaf(leaf);
  const Project before = document.project();
  QImage after = leaf.mask;
  after.setPixelColor(70, 10, Qt::white);
  after.setPixelColor(199, 149, Qt::white);
  const Project* project = &document.project();
  QRect dirty;
  connect(&document, &Document::changed, this, [&](const Change& change) { dirty = change.dirty; });
  document.paintMask(id, after, {}, "Brush");
  QCOMPARE(project->leaf(id)->mask, after);
  const auto* command = dynamic_cast<const PaintMask*>(document.undoStack().command(1));
  QVERIFY(command);
  // Two tiles: a whole one, and the last one, cut by the border: 200 - 192 by 150 - 128.
  QCOMPARE(command->bytes(), qsizetype(64 * 64 + 8 * 22));
  QCOMPARE(dirty, QRect(64, 0, 136, 150));
  document.undoStack().undo();
  QCOMPARE(document.project(), before);
  document.undoStack().redo();
  QCOMPARE(project->leaf(id)->mask, after);
  document.paintMask(id, after, {}, "Brush");
  QCOMPARE(document.undoStack().count(), 2);
}

void DocumentTest::theFirstStrokeOnAnAutomaticMaskCanBeUndone() {
  Document document;
  const AssetId id = document.addLeaf(leafNamed("Oak"));
  const QImage painted = plainMask({80, 60}, 255);
  document.paintMask(id, painted.convertToFormat(QImage::Format_RGB32), QRect(3, 3, 2, 2), "Brush");
  QCOMPARE(document.project().leaf(id)->mask, painted);
  document.undoStack().undo();
  QVERIFY(document.project().leaf(id)->mask.isNull());
  document.undoStack().redo();
  QCOMPARE(document.project().leaf(id)->mask, painted);
}

WINDFALL_SUITE(DocumentTest)
#include "document.moc"
