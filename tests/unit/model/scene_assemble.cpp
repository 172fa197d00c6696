// A project becomes what the simulation needs.
#include "model/scene/assemble.h"

#include <QtTest>
#include <utility>

#include "model/scene/layer_plan.h"
#include "support/gltf_fixture.h"
#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;

namespace {

Project projectWithTwoTrees() {
  Project project;
  Plant plant;
  plant.id = {1};
  plant.name = "hand-made";
  plant.file = {"p.glb", test::GltfFixture().glb()};
  project.plants.push_back(plant);
  TreePlacement tree;
  tree.id = {2};
  tree.plant = {1};
  project.scene.trees.push_back(tree);
  tree.id = {3};
  tree.scale = 3;
  tree.heading = 90;
  tree.position = {5, 0, -2};
  project.scene.trees.push_back(tree);
  project.scene.wind.speed = 7;
  project.scene.seed = 42;
  project.nextId = 4;
  return project;
}

Variant variant(bool keep) {
  Variant result;
  result.keep = keep;
  result.image = QImage(4, 4, QImage::Format_RGBA8888);
  return result;
}

}  // namespace

class SceneAssembleTest : public QObject {
  Q_OBJECT
 private slots:
  void treesOfOnePlantShareIt();
  void aShapeIsMadeAgainOnlyWhenItChanges();
  void scaleIsFoldedIntoTheTree();
  void settingsGoToTheSimulation();
  void everyPlaceHasItsLeafUnlessANumberIsGiven();
  void brokenScenesNameWhatIsWrong();
  void layersFollowTheKeptVariants();
  void treesWithoutLeavesGetAPaintedOne();
};

void SceneAssembleTest::treesOfOnePlantShareIt() {
  Progress progress;
  const auto assembly = assembleTrees(projectWithTwoTrees(), progress);
  QVERIFY2(assembly, assembly ? "" : assembly.error().message.c_str());
  QCOMPARE(assembly->plants.size(), std::size_t(1));
  QCOMPARE(assembly->trees, (std::vector<AssetId>{{2}, {3}}));
  QCOMPARE(assembly->sim.trees.size(), std::size_t(2));
  QCOMPARE(assembly->sim.trees[0].tree.get(), &assembly->plants.at({1}).bodies->tree);
}

void SceneAssembleTest::aShapeIsMadeAgainOnlyWhenItChanges() {
  GeometryCache shapes;
  Progress progress;
  Project project = projectWithTwoTrees();
  const auto shape = [&] { return assembleTrees(project, progress, &shapes)->plants.at({1}).geometry; };
  const auto first = shape();
  project.plants[0].name = QStringLiteral("another name");
  project.plants[0].edits[QStringLiteral("trunk")].stiffness = 3;
  project.plants[0].leafDensity = 0.5;
  QCOMPARE(shape(), first);
  const SourceFile file = std::exchange(project.plants[0].file, {});
  project.plants[0].grower = GrowerSettings{.height = 3, .limbs = 4, .levels = 2};
  const auto grown = shape();
  QVERIFY(grown != first);
  project.plants[0].grower->seed += 1;
  QVERIFY(shape() != grown);
  project.plants[0].grower.reset();
  project.plants[0].file = file;
  QCOMPARE(shape(), first);
}

void SceneAssembleTest::scaleIsFoldedIntoTheTree() {
  Progress progress;
  const auto assembly = assembleTrees(projectWithTwoTrees(), progress);
  QVERIFY(assembly);
  const sim::Tree &one = *assembly->sim.trees[0].tree, &three = *assembly->sim.trees[1].tree;
  for (std::size_t i = 0; i < one.links.size(); ++i) {
    QVERIFY(glm::length(three.links[i].joint - 3.f * one.links[i].joint) < 1e-5f);
    QCOMPARE(three.links[i].length, 3 * one.links[i].length);
    QCOMPARE(three.links[i].radius, 3 * one.links[i].radius);
    QCOMPARE(three.links[i].leafArea, 9 * one.links[i].leafArea);
  }
  QCOMPARE(three.sites.at(0).size, 3 * one.sites.at(0).size);
  QVERIFY(std::abs(sim::totalMass(three) / sim::totalMass(one) - 27) < 20);
  QCOMPARE(assembly->sim.trees[1].placement.position.x, 5.f);
  QVERIFY(std::abs(assembly->sim.trees[1].placement.heading - 1.5707963f) < 1e-6f);
}

void SceneAssembleTest::settingsGoToTheSimulation() {
  Progress progress;
  const auto assembly = assembleTrees(projectWithTwoTrees(), progress);
  QVERIFY(assembly);
  QCOMPARE(assembly->sim.wind.speed, 7.f);
  QCOMPARE(assembly->sim.seed, std::uint64_t(42));
  QCOMPARE(assembly->sim.leafLayers, 1u);
  Progress again;
  QVERIFY(sim::Engine::create(assembly->sim, sim::Device::Cpu, 1));
}

void SceneAssembleTest::everyPlaceHasItsLeafUnlessANumberIsGiven() {
  Progress progress;
  Project project;
  Plant plant;
  plant.id = {1};
  plant.grower = GrowerSettings{};
  project.plants.push_back(plant);
  for (const quint64 id : {2, 3}) {
    TreePlacement tree;
    tree.id = {id};
    tree.plant = {1};
    project.scene.trees.push_back(tree);
  }
  const Result<SceneAssembly> every = assembleTrees(project, progress);
  QVERIFY(bool(every));
  const std::size_t sites = every->sim.trees[0].tree->sites.size();
  QVERIFY(sites > 100);
  QCOMPARE(every->sim.leaves.count, static_cast<std::int32_t>(2 * sites));
  project.scene.leaves.count = 7;
  QCOMPARE(assembleTrees(project, progress)->sim.leaves.count, 7);
  // In the air there are no places to count.
  project.scene.leaves.count = kEveryLeaf;
  project.scene.leaves.spawnHeight = 10;
  QCOMPARE(assembleTrees(project, progress)->sim.leaves.count, sim::LeafSettings().count);
}

void SceneAssembleTest::brokenScenesNameWhatIsWrong() {
  Progress progress;
  Project gone = projectWithTwoTrees();
  gone.scene.trees[1].plant = {9};
  gone.scene.trees[1].name = "lost";
  const auto lost = assembleTrees(gone, progress);
  QVERIFY(!lost && QString::fromStdString(lost.error().message).contains("lost"));
  Project damaged = projectWithTwoTrees();
  damaged.plants[0].file.bytes.truncate(100);
  const auto bad = assembleTrees(damaged, progress);
  QVERIFY(!bad && QString::fromStdString(bad.error().message).contains("hand-made"));
  Project flat = projectWithTwoTrees();
  flat.scene.trees[0].scale = 0;
  QVERIFY(!assembleTrees(flat, progress));
}

void SceneAssembleTest::layersFollowTheKeptVariants() {
  Project project = projectWithTwoTrees();
  Leaf oak, birch;
  oak.id = {10};
  oak.variants = {variant(true), variant(false), variant(true)};
  birch.id = {11};
  birch.variants = {variant(true)};
  project.leaves = {oak, birch};
  Plant bare = project.plants[0], mixed = bare, same = bare;
  bare.id = {20};
  mixed.id = {21};
  mixed.leaves = {{10}, {11}};
  same.id = {22};
  same.leaves = mixed.leaves;
  project.plants = {bare, mixed, same};
  const LayerPlan plan = planLayers(project);
  // The stand-in, two of the oak, one of the birch; plants with the same leaves share theirs.
  QCOMPARE(plan.layers, (std::vector<LayerSource>{{}, {{10}, 0}, {{10}, 2}, {{11}, 0}}));
  QCOMPARE(plan.ofPlant.at({20}).first, 0);
  QCOMPARE(plan.ofPlant.at({21}).first, 1);
  QCOMPARE(plan.ofPlant.at({21}).count, 3);
  QCOMPARE(plan.ofPlant.at({22}).first, 1);
  QCOMPARE(planLayers(Project{}).layers.size(), std::size_t(1));
}

void SceneAssembleTest::treesWithoutLeavesGetAPaintedOne() {
  Progress progress;
  const auto assembly = assembleScene(projectWithTwoTrees(), progress);
  QVERIFY2(assembly, assembly ? "" : assembly.error().message.c_str());
  QCOMPARE(assembly->leafTextures.size(), std::size_t(1));
  const LeafTexture& leaf = assembly->leafTextures[0];
  QVERIFY(leaf.image.width() > 64 && leaf.image.height() > leaf.image.width());
  QCOMPARE(qAlpha(leaf.image.pixel(0, 0)), 0);
  QCOMPARE(qAlpha(leaf.image.pixel(leaf.image.width() / 2, leaf.image.height() / 2)), 255);
  // The petiole's end lies at the bottom.
  QVERIFY(leaf.pivot.y() > 0.7 && std::abs(leaf.pivot.x() - 0.5) < 0.3);
  QVERIFY(leaf.metres.height() > 0.07 && leaf.metres.height() < 0.2);
}

WINDFALL_SUITE(SceneAssembleTest)
#include "scene_assemble.moc"
