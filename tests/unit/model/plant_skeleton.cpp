// Skeleton files as plants: JSON, geometry, settings.
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QtTest>

#include "model/plant/bark.h"
#include "model/plant/bodies.h"
#include "model/plant/import.h"
#include "model/plant/json_skeleton.h"
#include "model/plant/skeleton_geometry.h"
#include "model/plant/skeleton_importer.h"
#include "support/skeleton_data.h"
#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;

namespace {

Plant plantOf(const QString& name, const QByteArray& bytes) {
  Plant plant;
  plant.file = {name, bytes};
  return plant;
}

Plant smallPrim() { return plantOf("small.prim", *writePrim(test::smallTree(), 4)); }

Result<PlantGeometry> load(const Plant& plant) {
  Progress progress;
  return loadGeometry(plant, progress);
}

const char* const kJson = R"({"Nodes": [
  {"ID": 1, "Position": [0, 0, 0], "Radius": 0.1, "children": [2], "branch": 0},
  {"id": 2, "position": [0, 1, 0], "radius": 0.08, "rotation": [0, 0, 0], "children": [3, 4], "branch": 0},
  {"id": 3, "position": [0, 1.5, 0], "radius": 0.05, "branch": 1, "species": "none"},
  {"id": 4, "position": [0.5, 1.5, 0], "radius": 0.03, "branch": 0}]})";

}  // namespace

class PlantSkeletonTest : public QObject {
  Q_OBJECT
 private slots:
  void jsonBecomesSegments();
  void jsonWrittenIsReadTheSame();
  void badJsonIsOneLine_data();
  void badJsonIsOneLine();
  void primPlantsAreMeshedBentAndLeaved();
  void rootsObstaclesAndBudsAreShown();
  void scaleEnlargesEverything();
  void chainsFollowTheSetting();
  void greenStemsAndDryLeavesShow();
  void importedMeshesCanBeMeshedAnew();
  void theGrowersTreeHasTheSurface();
  void barkTilesRepeatAndDiffer();
};

void PlantSkeletonTest::jsonBecomesSegments() {
  const Result<JsonSkeleton> read = readJsonSkeleton(kJson);
  QVERIFY2(read, read ? "" : read.error().message.c_str());
  const SkeletonGraph& graph = read->graph;
  QCOMPARE(graph.segments.size(), std::size_t{3});
  QCOMPARE(read->warnings.size(), 1);
  QVERIFY(read->warnings[0].contains("species"));
  QCOMPARE(graph.segments[0].b, vec3(0, 1, 0));
  // The file's branch 0 goes on to node 4, though node 3 lies straight ahead.
  const Chains chains = findChains(graph);
  QCOMPARE(chains.chains.size(), std::size_t{2});
  QCOMPARE(chains.ofSegment[2], 0);
  const Result<PlantGeometry> geometry = load(plantOf("plant.json", kJson));
  QVERIFY(geometry);
  QCOMPARE(geometry->format, QString("json"));
  QCOMPARE(geometry->bones.size(), std::size_t{3});
}

void PlantSkeletonTest::jsonWrittenIsReadTheSame() {
  std::vector<SkeletonGraph> graphs{test::smallTree(), readJsonSkeleton(kJson)->graph};
  const SkeletonGraph real = test::primFile("default_502_v4.prim");
  if (!real.segments.empty()) graphs.push_back(real);
  for (const SkeletonGraph& graph : graphs) {
    const QByteArray once = writeJsonSkeleton(graph, findChains(graph).ofSegment);
    const Result<JsonSkeleton> read = readJsonSkeleton(once);
    QVERIFY2(read, read ? "" : read.error().message.c_str());
    QCOMPARE(read->graph.segments.size(), graph.segments.size());
    double before = 0, after = 0;
    for (const Segment& s : graph.segments) before += static_cast<double>(glm::length(s.b - s.a));
    for (const Segment& s : read->graph.segments) after += static_cast<double>(glm::length(s.b - s.a));
    QVERIFY(std::abs(before - after) < 1e-4);
    QCOMPARE(findChains(read->graph).chains.size(), findChains(graph).chains.size());
    const QByteArray twice = writeJsonSkeleton(read->graph, findChains(read->graph).ofSegment);
    const Result<JsonSkeleton> again = readJsonSkeleton(twice);
    QVERIFY(again);
    QVERIFY(again->graph ==
            readJsonSkeleton(writeJsonSkeleton(again->graph, findChains(again->graph).ofSegment))->graph);
  }
  // A branch that leaves the middle of a segment: the segment is split there.
  SkeletonGraph middle;
  middle.segments = {test::segment({0, 0, 0}, {0, 2, 0}, 0.1f, -1), test::segment({0, 1, 0}, {1, 1, 0}, 0.02f, 0)};
  finishGraph(middle);
  const Result<JsonSkeleton> split = readJsonSkeleton(writeJsonSkeleton(middle, {0, 1}));
  QVERIFY(split);
  QCOMPARE(split->graph.segments.size(), std::size_t{3});
}

void PlantSkeletonTest::badJsonIsOneLine_data() {
  QTest::addColumn<QByteArray>("bytes");
  QTest::addColumn<QString>("says");
  QTest::newRow("no JSON") << QByteArray("{\"nodes\": [\n nonsense") << "line 2";
  QTest::newRow("no nodes") << QByteArray("{}") << "no list of nodes";
  QTest::newRow("none") << QByteArray("{\"nodes\": []}") << "no plants";
  QTest::newRow("one node") << QByteArray("{\"nodes\": [{\"position\": [0, 0, 0]}]}") << "no plants";
  QTest::newRow("no position") << QByteArray("{\"nodes\": [{\"id\": 5}]}") << "node 5: has no position";
  QTest::newRow("child not there") << QByteArray(R"({"nodes": [{"id": 1, "position": [0,0,0], "children": [9]}]})")
                                   << "its child 9 is not there";
  QTest::newRow("same id") << QByteArray(
                                  R"({"nodes": [{"id": 1, "position": [0,0,0]}, {"id": 1, "position": [0,0,0]}]})")
                           << "the id 1";
  QTest::newRow("circle") << QByteArray(R"({"nodes": [{"id": 1, "position": [0,0,0], "children": [2]},
                                            {"id": 2, "position": [0,1,0], "children": [1]}]})")
                          << "circle";
  QTest::newRow("two parents") << QByteArray(
                                      R"({"nodes": [{"id": 1, "position": [0,0,0], "children": [3]},
                                          {"id": 2, "position": [0,1,0], "children": [3]}, {"id": 3, "position": [0,2,0]}]})")
                               << "another parent";
  QTest::newRow("endless")
      << QByteArray(
             R"({"nodes": [{"id": 1, "position": [0,0,0], "children": [2]}, {"id": 2, "position": [0,1e300,0]}]})")
      << "no number";
  QTest::newRow("deep") << QByteArray("{\"nodes\": ").append(QByteArray(100'000, '[')) << "nested deeper";
}

void PlantSkeletonTest::badJsonIsOneLine() {
  QFETCH(QByteArray, bytes);
  QFETCH(QString, says);
  const Result<JsonSkeleton> read = readJsonSkeleton(bytes);
  QVERIFY(!read);
  const QString message = QString::fromStdString(read.error().message);
  QVERIFY2(message.contains(says), qPrintable(message));
  QVERIFY(!message.contains('\n'));
}

void PlantSkeletonTest::primPlantsAreMeshedBentAndLeaved() {
  const Plant plant = smallPrim();
  const Result<PlantGeometry> geometry = load(plant);
  QVERIFY2(geometry, geometry ? "" : geometry.error().message.c_str());
  const SkeletonGraph made = test::smallTree();
  QCOMPARE(geometry->format, QString("prim"));
  QCOMPARE(geometry->bones.size(), made.segments.size());
  QCOMPARE(geometry->leafSites.size(), made.leaves.size());
  QVERIFY(geometry->skeleton != nullptr);
  QVERIFY(!geometry->materials[0].texture.isNull() && !geometry->materials[0].normalMap.isNull());
  const PlantBodies bodies = buildBodies(*geometry, plant);
  QCOMPARE(bodies.tree.links.size(), made.segments.size());
  QCOMPARE(bodies.tree.sites.size(), made.leaves.size());
  const PlantInfo info = describe(*geometry, bodies);
  QCOMPARE(info.stems, static_cast<int>(made.segments.size()));
  QCOMPARE(info.leaves, static_cast<int>(made.leaves.size()));
  QCOMPARE(info.buds, 1);
  QCOMPARE(info.plants, 1);
  QVERIFY(info.mass > 0 && info.firstFrequency > 0);
  // A leaf hangs where the file has it.
  const sim::LeafSite& site = geometry->leafSites[0];
  const Bone& bone = geometry->bones[static_cast<std::size_t>(site.link)];
  QVERIFY(glm::length(bone.tail - made.leaves[0].base) < 1e-5f);
  QVERIFY(std::abs(site.size - glm::length(made.leaves[0].tip - made.leaves[0].base)) < 1e-5f);
}

void PlantSkeletonTest::rootsObstaclesAndBudsAreShown() {
  SkeletonGraph graph = test::smallTree(2);
  Segment root = test::segment({0, 0, 0}, {0.1f, -0.4f, 0}, 0.02f, -1);
  root.kind = SegmentKind::Root;
  graph.segments.push_back(root);
  Progress progress;
  const Result<PlantGeometry> geometry = geometryOf(graph, {}, "prim", progress);
  QVERIFY(geometry);
  float lowest = 0;
  for (const std::uint32_t index : geometry->indices) lowest = std::min(lowest, geometry->vertices[index].position.y);
  QVERIFY(lowest < -0.39f);
  SurfaceSettings bare;
  bare.roots = false;
  const Result<PlantGeometry> above = geometryOf(graph, bare, "prim", progress);
  QVERIFY(above->indices.size() < geometry->indices.size());
  graph.obstacles.push_back({{{0, 0, 1}, {1, 0, 1}, {1, 1, 1}}, {0, 1, 2}});
  const Result<PlantGeometry> walled = geometryOf(graph, {}, "prim", progress);
  QStringList names;
  for (const Material& material : walled->materials) names << material.name;
  QCOMPARE(names, QStringList({"bark", "bud", "obstacle"}));
  // Roots do not sway.
  QCOMPARE(buildBodies(*geometry, {}).tree.links.size(), graph.segments.size() - 1);
}

void PlantSkeletonTest::scaleEnlargesEverything() {
  Plant plant = smallPrim();
  const Result<PlantGeometry> once = load(plant);
  plant.surface.scale = 3;
  const Result<PlantGeometry> thrice = load(plant);
  for (std::size_t b = 0; b < once->bones.size(); ++b) {
    QVERIFY(glm::length(thrice->bones[b].tail - 3.0f * once->bones[b].tail) < 1e-5f);
    QVERIFY(std::abs(thrice->bones[b].radius - 3 * once->bones[b].radius) < 1e-6f);
  }
  QVERIFY(std::abs(thrice->leafSites[0].size - 3 * once->leafSites[0].size) < 1e-5f);
}

void PlantSkeletonTest::chainsFollowTheSetting() {
  // A short straight way and a long one aside.
  SkeletonGraph graph;
  graph.segments = {test::segment({0, 0, 0}, {0, 1, 0}, 0.05f, -1), test::segment({0, 1, 0}, {0, 1.5f, 0}, 0.05f, 0),
                    test::segment({0, 1, 0}, {0.6f, 1.1f, 0}, 0.03f, 0)};
  Plant plant = plantOf("fork.prim", *writePrim(graph, 4));
  plant.surface.chains.rule = ChainRule::Longest;
  std::vector<Branch> branches = findBranches(load(plant)->bones);
  QCOMPARE(branches[0].bones, (std::vector<int>{0, 2}));
  plant.surface.chains.rule = ChainRule::Score;
  branches = findBranches(load(plant)->bones);
  QCOMPARE(branches[0].bones, (std::vector<int>{0, 1}));
}

void PlantSkeletonTest::greenStemsAndDryLeavesShow() {
  SkeletonGraph graph = test::smallTree(2);
  for (Segment& s : graph.segments) s.state.wood = s.parent < 0 ? 1.0f : 0.0f;
  for (LeafOrgan& leaf : graph.leaves) leaf.state.water = 0.2f;
  Progress progress;
  SurfaceSettings settings;
  const Result<PlantGeometry> dry = geometryOf(graph, settings, "prim", progress);
  settings.followsState = false;
  const Result<PlantGeometry> plain = geometryOf(graph, settings, "prim", progress);
  const auto greenest = [](const PlantGeometry& geometry) {
    std::uint8_t least = 255;
    for (const Vertex& vertex : geometry.vertices) least = std::min(least, vertex.tint[3]);
    return static_cast<int>(least);
  };
  QCOMPARE(greenest(*dry), 0);
  QCOMPARE(greenest(*plain), 255);
  const auto fall = [](const PlantGeometry& geometry) {
    const sim::LeafSite& site = geometry.leafSites[0];
    return site.rotation;
  };
  QVERIFY(std::abs(glm::dot(fall(*dry), fall(*plain))) < 0.99f);
}

void PlantSkeletonTest::importedMeshesCanBeMeshedAnew() {
  PlantGeometry geometry;
  for (int i = 0; i < 4; ++i) {
    Bone bone;
    bone.name = QString::number(i);
    bone.parent = i - 1;
    bone.head = {0, static_cast<float>(i), 0};
    bone.tail = {0.1f * static_cast<float>(i), static_cast<float>(i + 1), 0};
    bone.radius = 0.05f;
    bone.weighted = i != 0;
    geometry.bones.push_back(bone);
  }
  geometry.leafSites.resize(1);
  geometry.leafSites[0].link = 3;
  Progress progress;
  SurfaceSettings settings;
  const Result<PlantGeometry> kept = withSurface(geometry, settings, progress);
  QVERIFY(kept->vertices.empty() && kept->skeleton != nullptr);
  settings.fromSkeleton = true;
  const Result<PlantGeometry> anew = withSurface(geometry, settings, progress);
  QVERIFY(!anew->vertices.empty());
  QCOMPARE(anew->bones.size(), std::size_t{4});
  QCOMPARE(anew->leafSites.size(), std::size_t{1});
  for (const Vertex& vertex : anew->vertices) {
    for (std::size_t k = 0; k < 2; ++k)
      QVERIFY(vertex.weights[k] == 0 || (vertex.bones[k] >= 1 && vertex.bones[k] < 4));
  }
}

void PlantSkeletonTest::theGrowersTreeHasTheSurface() {
  Plant plant;
  plant.grower = GrowerSettings{};
  plant.grower->limbs = 6;
  const Result<PlantGeometry> geometry = load(plant);
  QVERIFY(geometry);
  QVERIFY(geometry->skeleton != nullptr);
  QCOMPARE(geometry->skeleton->graph.segments.size(), geometry->bones.size());
  QVERIFY(std::any_of(geometry->vertices.begin(), geometry->vertices.end(),
                      [](const Vertex& vertex) { return vertex.repeats > 0; }));
}

void PlantSkeletonTest::barkTilesRepeatAndDiffer() {
  std::vector<QImage> seen;
  for (const BarkKind kind :
       {BarkKind::Oak, BarkKind::Birch, BarkKind::Beech, BarkKind::Pine, BarkKind::Maple, BarkKind::Herb}) {
    const BarkTile tile = barkTile(kind, 1, 128);
    for (const QImage& other : seen) QVERIFY(other != tile.colour);
    seen.push_back(tile.colour);
    // Across the border the picture goes on: its step is like those inside.
    const auto step = [&](int x0, int x1) {
      double sum = 0;
      for (int y = 0; y < 128; ++y) sum += std::abs(qGray(tile.colour.pixel(x0, y)) - qGray(tile.colour.pixel(x1, y)));
      return sum / 128;
    };
    double inside = 0;
    for (int x = 0; x + 1 < 128; ++x) inside = std::max(inside, step(x, x + 1));
    QVERIFY(step(127, 0) <= 1.1 * inside);
    for (int y = 0; y < 128; y += 7) {
      const QRgb n = tile.normals.pixel(3 * y % 128, y);
      const double x = qRed(n) / 127.5 - 1, v = qGreen(n) / 127.5 - 1, z = qBlue(n) / 127.5 - 1;
      QVERIFY(std::abs(std::sqrt(x * x + v * v + z * z) - 1) < 0.03 && z > 0);
    }
  }
  QVERIFY(barkTile(BarkKind::Oak, 2, 64).colour != barkTile(BarkKind::Oak, 3, 64).colour);
}

WINDFALL_SUITE(PlantSkeletonTest)
#include "plant_skeleton.moc"
