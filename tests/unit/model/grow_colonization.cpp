// Space colonization: the note's numbers, its traps, crowns that are drawn, imported or empty.
#include <QtTest>
#include <algorithm>
#include <cmath>
#include <limits>

#include "model/plant/grow/colonization.h"
#include "model/plant/grow/crown_volume.h"
#include "model/plant/grow/grow_skeleton.h"
#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;
using namespace windfall::model::growth;

namespace {

/// Out of line: GCC 12 sees overruns in inlined short strings that are none.
[[gnu::noinline]] std::string str(const char* text) { return text; }

Plant oak() {
  Plant plant;
  plant.grower = GrowerSettings();
  GrowerSettings& g = *plant.grower;
  g.method = GrowMethod::SpaceColonization;
  g.height = 16, g.baseRadius = 0.38, g.seed = 11;
  ColonizationSettings& c = g.colonization;
  c.crown = {3.2, 7.5, 0.40, 1.9, 2.0, {}};
  c.points = 9000, c.shell = 0.38, c.step = 0.20, c.influence = 2.6, c.kill = 0.40, c.upward = 0.06;
  c.trunkTop = 4.6, c.trunkWander = 0.35, c.noise = 0.50, c.lobes = 26, c.lobeSize = 0.36;
  return plant;
}

/// A smaller and quicker one.
Plant sapling() {
  Plant plant = oak();
  plant.grower->colonization.points = 1200;
  plant.grower->colonization.step = 0.3;
  plant.grower->colonization.kill = 0.8;
  return plant;
}

std::vector<dvec3> pointsOf(const Plant& plant, const SourceFile& mesh = {}) {
  Progress progress;
  Result<std::vector<dvec3>> points =
      crownPoints(plant.grower->colonization, mesh, plant.grower->height, plant.grower->seed, progress);
  if (!points) qWarning("%s", points.error().message.c_str());
  return points ? std::move(*points) : std::vector<dvec3>{};
}

Colonized colonyOf(const Plant& plant) {
  Progress progress;
  const std::vector<dvec3> points = pointsOf(plant);
  const Result<Grown> chain = seedTrunks(plant.grower->colonization, plant.grower->height, points, plant.grower->seed);
  return colonize(plant.grower->colonization, points, *chain, plant.grower->seed, {}, progress);
}

Grown grownOf(const Plant& plant) {
  Progress progress;
  Result<GrownSkeleton> result = growSkeleton(plant, progress);
  if (!result) qWarning("%s", result.error().message.c_str());
  return result ? std::move(result->grown) : Grown{};
}

std::string errorOf(const Plant& plant) {
  Progress progress;
  const Result<GrownSkeleton> result = growSkeleton(plant, progress);
  return result ? "" : result.error().message;
}

double heightOf(const Grown& grown) {
  double height = 0;
  for (const dvec3& p : grown.position) height = std::max(height, p.y);
  return height;
}

double lengthOf(const Grown& grown) {
  double length = 0;
  for (std::size_t i = 1; i < grown.size(); ++i)
    length += glm::length(grown.position[i] - grown.position[at(grown.parent[i])]);
  return length;
}

/// A box with a hole in one side, as OBJ.
SourceFile boxMesh() {
  return {
      QStringLiteral("box.obj"),
      "v -2 3 -1\nv 2 3 -1\nv 2 9 -1\nv -2 9 -1\nv -2 3 1\nv 2 3 1\nv 2 9 1\nv -2 9 1\n"
      "f 1 3 2\nf 1 4 3\nf 5 6 7\nf 5 7 8\nf 1 2 6\nf 1 6 5\nf 4 8 7\nf 4 7 3\nf 1 5 8\nf 1 8 4\nf 2 3 7\nf 2 7 6\n"};
}

}  // namespace

class GrowColonizationTest : public QObject {
  Q_OBJECT
 private slots:
  void theOakIsTheNotesOak();
  void equalsBruteForceNodeForNode();
  void oppositePointsDoNotMakeItEndless();
  void ageReplaysGrowth();
  void pipeModelGivesTheNotesRadii();
  void skeletonsAreSoundForEverySeed();
  void drawnOutlinesAreFilledOnBothSides();
  void importedMeshesAreFilled();
  void emptyCrownsAreRefused();
  void nonsenseIsRefused();
  void cancelledGrowthSaysSo();
};

void GrowColonizationTest::theOakIsTheNotesOak() {
  const Colonized colony = colonyOf(oak());
  QVERIFY2(std::abs(static_cast<double>(colony.grown.size()) / 8838 - 1) < 0.2,
           qPrintable(QString::number(colony.grown.size())));
  QVERIFY(colony.rounds < 200);
  QVERIFY(colony.unreachable < 300);
  const Grown grown = grownOf(oak());
  QVERIFY2(std::abs(static_cast<double>(grown.size()) / 7660 - 1) < 0.2, qPrintable(QString::number(grown.size())));
  QVERIFY2(std::abs(heightOf(grown) / 15.95 - 1) < 0.03, qPrintable(QString::number(heightOf(grown))));
  QVERIFY2(std::abs(lengthOf(grown) / 1603 - 1) < 0.2, qPrintable(QString::number(lengthOf(grown))));
  const std::vector<int> orders = ordersOf(grown);
  const int order = *std::max_element(orders.begin(), orders.end());
  QVERIFY2(order >= 4 && order <= 6, qPrintable(QString::number(order)));
  QVERIFY(std::abs(grown.radius[0] - 0.38) < 1e-4);
}

void GrowColonizationTest::equalsBruteForceNodeForNode() {
  Plant plant = sapling();
  ColonizationSettings& c = plant.grower->colonization;
  c.noise = 0;
  const std::vector<dvec3> points = pointsOf(plant);
  const Grown chain = *seedTrunks(c, plant.grower->height, points, 1);
  Grown slow = chain;
  std::vector<char> alive(points.size(), 1);
  const double kill = std::max(c.kill, 1.5 * c.step);
  for (int round = 1; round < 4000; ++round) {
    std::vector<int> near(points.size(), -1);
    for (std::size_t a = 0; a < points.size(); ++a) {
      double least = c.influence * c.influence;
      for (std::size_t j = 0; j < slow.size(); ++j) {
        const dvec3 way = points[a] - slow.position[j];
        if (glm::dot(way, way) < least) least = glm::dot(way, way), near[a] = static_cast<int>(j);
      }
      if (least < kill * kill) alive[a] = 0;
    }
    bool happened = false;
    const std::size_t before = slow.size();
    for (std::size_t j = 0; j < before; ++j) {
      dvec3 sum(0);
      int count = 0;
      for (std::size_t a = 0; a < points.size(); ++a) {
        if (alive[a] && near[a] == static_cast<int>(j)) sum += glm::normalize(points[a] - slow.position[j]), ++count;
      }
      if (count == 0) continue;
      happened = true;
      const dvec3 q = slow.position[j] + c.step * glm::normalize(glm::normalize(sum) + dvec3(0, c.upward, 0));
      bool repeats = glm::length(sum) < 0.05 * count;
      for (std::size_t k = 1; k < slow.size(); ++k) {
        repeats =
            repeats || (slow.parent[k] == static_cast<int>(j) && glm::length(slow.position[k] - q) < 0.25 * c.step);
      }
      if (!repeats) {
        slow.add(q, static_cast<int>(j), round);
        continue;
      }
      for (std::size_t a = 0; a < points.size(); ++a) {
        if (near[a] == static_cast<int>(j)) alive[a] = 0;
      }
    }
    if (!happened) break;
  }
  Progress progress;
  const Colonized fast = colonize(c, points, chain, plant.grower->seed, {}, progress);
  QCOMPARE(fast.grown.size(), slow.size());
  QVERIFY(slow.size() > 500);
  for (std::size_t i = 0; i < slow.size(); ++i) {
    QCOMPARE(fast.grown.parent[i], slow.parent[i]);
    QVERIFY(glm::length(fast.grown.position[i] - slow.position[i]) < 1e-9);
  }
}

void GrowColonizationTest::oppositePointsDoNotMakeItEndless() {
  ColonizationSettings c;
  c.step = 0.2, c.influence = 3, c.kill = 0.1, c.noise = 0, c.upward = 0;
  Grown chain;
  chain.add(dvec3(0), -1, 0);
  chain.add(dvec3(0, 1, 0), 0, 0, true);
  Progress progress;
  const Colonized colony = colonize(c, {{2, 1, 0}, {-2, 1, 0}}, chain, 1, {}, progress);
  QVERIFY(colony.grown.size() < 40);
  QVERIFY(colony.rounds < 60);
}

void GrowColonizationTest::ageReplaysGrowth() {
  std::size_t last = 0;
  double lastHeight = 0, lastRadius = 0;
  for (const double age : {8.0, 16.0, 28.0, 44.0, 60.0, 90.0}) {
    Plant plant = oak();
    plant.grower->age = age;
    const double share = maturityShare(*plant.grower);
    const Grown grown = grownOf(plant);
    QVERIFY(grown.size() >= last);
    QVERIFY(heightOf(grown) >= lastHeight);
    QVERIFY(grown.radius[0] >= lastRadius);
    if (share >= 0.2)
      QVERIFY2(std::abs(heightOf(grown) / (16 * share) - 1) < 0.25,
               qPrintable(QString::number(heightOf(grown) / share)));
    last = grown.size(), lastHeight = heightOf(grown), lastRadius = grown.radius[0];
  }
}

void GrowColonizationTest::pipeModelGivesTheNotesRadii() {
  Grown fork;
  fork.add({0, 0, 0}, -1, 0);
  fork.add({0, 1, 0}, 0, 0);
  fork.add({0.3, 1.5, 0}, 1, 0);
  fork.add({-0.3, 1.5, 0}, 1, 0);
  for (const auto& [exponent, radius] : {std::pair{2.0, 14.1421}, {2.5, 13.1951}, {3.0, 12.5992}}) {
    QVERIFY(std::abs(pipeRadii(fork, 0.010, 0, exponent) * 1000 - radius) < 1e-4);
  }
  setRadii(fork, 0.002, 0.05);
  QVERIFY(std::abs(fork.radius[0] - 0.05) < 1e-5);
  for (std::size_t i = 1; i < fork.size(); ++i) QVERIFY(fork.radius[i] <= fork.radius[at(fork.parent[i])]);
}

void GrowColonizationTest::skeletonsAreSoundForEverySeed() {
  for (quint64 seed = 1; seed <= 4; ++seed) {
    Plant plant = sapling();
    plant.grower->seed = seed;
    plant.grower->colonization.stems = seed == 4 ? 3 : 1;
    plant.grower->colonization.hangingLength = seed == 2 ? 2 : 0;
    const Grown grown = grownOf(plant);
    QVERIFY(grown.size() > 100);
    for (std::size_t i = 1; i < grown.size(); ++i) {
      QVERIFY(grown.parent[i] >= 0 && grown.parent[i] < static_cast<int>(i));
      const double length = glm::length(grown.position[i] - grown.position[at(grown.parent[i])]);
      QVERIFY2(length > 1e-4 && length < 5, qPrintable(QString::number(length)));
      QVERIFY(grown.position[i].y > -0.05);
      QVERIFY(grown.radius[i] > 0 && grown.radius[i] <= grown.radius[at(grown.parent[i])] + 1e-12);
    }
    const Grown again = grownOf(plant);
    QVERIFY(grown.position == again.position && grown.radius == again.radius && grown.parent == again.parent);
  }
}

void GrowColonizationTest::drawnOutlinesAreFilledOnBothSides() {
  Plant plant = sapling();
  CrownSettings& crown = plant.grower->colonization.crown;
  crown.profile = {{0.1, 0}, {1, 0.5}, {0, 1}, {-0.1, 0}, {-0.3, 0.5}};
  plant.grower->colonization.lobes = 0;
  double right = 0, left = 0;
  for (const dvec3& p : pointsOf(plant)) {
    if (std::abs(p.z) < 0.5) right = std::max(right, p.x), left = std::max(left, -p.x);
    QVERIFY(p.y >= crown.base - 1e-9 && p.y <= plant.grower->height + 1e-9);
  }
  QVERIFY(right > 0.75 * crown.radius);
  QVERIFY(left < 0.45 * crown.radius);
  QVERIFY(grownOf(plant).size() > 100);
}

void GrowColonizationTest::importedMeshesAreFilled() {
  Plant plant = sapling();
  plant.crown = boxMesh();
  const std::vector<dvec3> points = pointsOf(plant, plant.crown);
  QCOMPARE(points.size(), std::size_t{1200});
  for (const dvec3& p : points) QVERIFY(std::abs(p.x) <= 2 && std::abs(p.z) <= 1 && p.y >= 3 && p.y <= 9);
  const Grown grown = grownOf(plant);
  QVERIFY(grown.size() > 100);
  QVERIFY(heightOf(grown) < 9.5);
}

void GrowColonizationTest::emptyCrownsAreRefused() {
  Plant plant = sapling();
  plant.grower->colonization.crown.base = 20;
  QCOMPARE(errorOf(plant), str("the crown is empty: its base lies above the tree's top"));
  plant = sapling();
  plant.grower->colonization.crown.radius = 0;
  QCOMPARE(errorOf(plant), str("the crown is empty: its radius must be 0.01 to 100 m"));
  plant = sapling();
  plant.grower->colonization.crown.profile = {{0.5, 0.2}};
  QCOMPARE(errorOf(plant), str("the drawn crown encloses nothing: give it two points or more"));
  plant.grower->colonization.crown.profile = {{0, 0}, {0, 1}};
  QCOMPARE(errorOf(plant), str("the drawn crown encloses nothing: give it two points or more"));
}

void GrowColonizationTest::nonsenseIsRefused() {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto expectError = [](const std::function<void(GrowerSettings&)>& spoil) {
    Plant plant = sapling();
    spoil(*plant.grower);
    const std::string error = errorOf(plant);
    QVERIFY(!error.empty());
    QVERIFY(error.find('\n') == std::string::npos);
  };
  expectError([](GrowerSettings& g) { g.age = -1; });
  expectError([&](GrowerSettings& g) { g.age = nan; });
  expectError([&](GrowerSettings& g) { g.height = nan; });
  expectError([&](GrowerSettings& g) { g.colonization.step = nan; });
  expectError([&](GrowerSettings& g) { g.colonization.noise = nan; });
  expectError([&](GrowerSettings& g) { g.colonization.crown.widest = nan; });
  expectError([](GrowerSettings& g) { g.colonization.points = 2'000'000'000; });
  expectError([](GrowerSettings& g) { g.colonization.influence = 1e9; });
  expectError([](GrowerSettings& g) { g.wood.tipRadius = 0; });
}

void GrowColonizationTest::cancelledGrowthSaysSo() {
  Progress progress;
  progress.cancel();
  const Result<GrownSkeleton> result = growSkeleton(oak(), progress);
  QVERIFY(!result && result.error().cancelled);
}

WINDFALL_SUITE(GrowColonizationTest)
#include "grow_colonization.moc"
