// Trees that the simulation would refuse: what the import lets through is mended, told, and sways.
#include <QTest>
#include <cmath>

#include "model/plant/import.h"
#include "model/plant/links_private.h"
#include "model/plant/live_edits.h"
#include "sim/bodies.h"
#include "sim/engine.h"
#include "support/gltf_fixture.h"
#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;

namespace {

/// The fixture with its whole rig scaled.
PlantGeometry scaled(double factor, QString& error) {
  test::GltfFixture fixture;
  fixture.set("nodes", 0, "scale", QJsonArray{factor, factor, factor});
  Plant plant;
  plant.file = {"giant.glb", fixture.glb()};
  Progress progress;
  auto read = loadGeometry(plant, progress);
  if (!read) error = QString::fromStdString(read.error().message);
  return read ? *std::move(read) : PlantGeometry{};
}

/// What the engine says to a tree; empty where it takes it and a second in the wind leaves only numbers.
QString refusal(const PlantBodies& bodies) {
  sim::SceneDescription scene;
  scene.trees.push_back({std::make_shared<sim::Tree>(bodies.tree), {}});
  scene.wind.speed = 8;
  scene.leaves.count = 0;
  auto engine = sim::Engine::create(scene, sim::Device::Cpu, 1);
  if (!engine) return QString::fromStdString(engine.error().message);
  for (int i = 0; i < 60; ++i) (*engine)->step();
  const sim::Statistics s = (*engine)->statistics();
  return std::isfinite(s.largestAngle) && std::isfinite(s.kineticEnergy) ? QString() : QString("not a number");
}

Bone bone(const char* name, int parent, vec3 head, vec3 tail, float radius) {
  return {QString(name), parent, head, tail, radius, true};
}

}  // namespace

class PlantMendedTest : public QObject {
  Q_OBJECT
 private slots:
  void aTreeOfUsualSizeIsLeftAlone() {
    QString error;
    const PlantGeometry geometry = scaled(1, error);
    QCOMPARE(error, QString());
    const PlantBodies bodies = buildBodies(geometry, {});
    QVERIFY2(bodies.notes.isEmpty(), qPrintable(bodies.notes.join(';')));
    QCOMPARE(refusal(bodies), QString());
  }

  void aFileOfGiantBonesIsMendedAndTold() {
    QString error;
    // Trunk bones of 30 km each: written in the wrong unit.
    const PlantGeometry geometry = scaled(3e4, error);
    QCOMPARE(error, QString());
    const PlantBodies bodies = buildBodies(geometry, {});
    QCOMPARE(bodies.tree.links.size(), std::size_t{2});
    const QString told = bodies.notes.join(';');
    QVERIFY2(told.contains("beyond all measure"), qPrintable(told));
    QCOMPARE(refusal(bodies), QString());
    // Told as an import's notes are, in `plant --info` too.
    const QStringList notes = describe(geometry, bodies).notes;
    for (const QString& note : bodies.notes) QVERIFY2(notes.contains(note), qPrintable(note));
  }

  void bonesBeyondTheWorldAreMended() {
    PlantGeometry geometry;
    geometry.bones = {bone("trunk", -1, {0, 0, 0}, {0, 2, 0}, 0.1f),
                      bone("far", 0, {0, 4e6f, 0}, {0, 4e6f + 3, 0}, 0.05f),
                      bone("on", 1, {0, 4e6f + 3, 0}, {0, 4e6f + 5, 0}, 0.04f)};
    const PlantBodies bodies = buildBodies(geometry, {});
    QVERIFY2(bodies.notes.join(';').contains("nowhere"), qPrintable(bodies.notes.join(';')));
    QVERIFY(sim::problemOf(bodies.tree).empty());
    QCOMPARE(refusal(bodies), QString());
  }

  void editsThatAreNoNumbersAreMended() {
    PlantGeometry geometry;
    geometry.bones = {bone("trunk", -1, {0, 0, 0}, {0, 2, 0}, 0.1f), bone("top", 0, {0, 2, 0}, {0, 3, 0}, 0.05f)};
    Plant plant;
    plant.edits["top"].youngsModulus = std::nan("");
    plant.edits["trunk"].damping = -3;
    const PlantBodies bodies = buildBodies(geometry, plant);
    QCOMPARE(bodies.notes.size(), 2);
    QCOMPARE(bodies.tree.links[1].youngsModulus, sim::Link{}.youngsModulus);
    QCOMPARE(refusal(bodies), QString());
  }

  void aPinnedLinkOfTheStiffestWoodIsTaken() {
    PlantGeometry geometry;
    geometry.bones = {bone("trunk", -1, {0, 0, 0}, {0, 2, 0}, 0.1f), bone("top", 0, {0, 2, 0}, {0, 3, 0}, 0.05f)};
    Plant plant;
    plant.edits["top"].stiffness = 1000;
    plant.edits["top"].pinned = true;
    const PlantBodies bodies = buildBodies(geometry, plant);
    QVERIFY2(bodies.notes.isEmpty(), qPrintable(bodies.notes.join(';')));
    QVERIFY(bodies.tree.links[1].stiffnessScale >= 1e6f);
    QVERIFY(sim::problemOf(*withEdits(bodies.tree, geometry, bodies, plant.edits)).empty());
    QCOMPARE(refusal(bodies), QString());
  }

  void linksPutInAnotherOrderKeepTheirBones() {
    // Link 1 is a child of link 2, and hangs on bone 7; bone 8 became no link and moves with bone 7.
    PlantBodies bodies;
    bodies.tree.links.resize(3);
    for (int i = 0; i < 3; ++i) {
      sim::Link& link = bodies.tree.links[static_cast<std::size_t>(i)];
      link.parent = i == 1 ? 2 : i - 2;
      link.joint = vec3(0, float(i), 0);
      link.length = 1;
      link.radius = 0.1f;
    }
    bodies.tree.links[0].parent = -1;
    bodies.boneOfLink = {5, 7, 6};
    bodies.linkOfBone = {-1, -1, -1, -1, -1, 0, 2, 1, -1};
    bodies.carrierOfBone = {0, 0, 0, 0, 0, 0, 2, 1, 1};
    mendLinks(bodies);
    QVERIFY2(bodies.notes.join(';').contains("another order"), qPrintable(bodies.notes.join(';')));
    QCOMPARE(bodies.boneOfLink, (std::vector<int>{5, 6, 7}));
    QCOMPARE(bodies.linkOfBone, (std::vector<int>{-1, -1, -1, -1, -1, 0, 1, 2, -1}));
    QCOMPARE(bodies.carrierOfBone, (std::vector<int>{0, 0, 0, 0, 0, 0, 1, 2, 2}));
    QCOMPARE(bodies.tree.links[2].joint, vec3(0, 1, 0));
    QVERIFY(sim::problemOf(bodies.tree).empty());
  }
};

WINDFALL_SUITE(PlantMendedTest)
#include "plant_mended.moc"
