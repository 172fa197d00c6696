// Self-organizing growth: light, vigour, growth curves, and plants of the note.
#include <QtTest>
#include <algorithm>
#include <cmath>

#include "model/plant/grow/grow_skeleton.h"
#include "model/plant/grow/self_organizing.h"
#include "model/plant/grow/shadow_grid.h"
#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;
using namespace windfall::model::growth;

namespace {

SelfOrganizingSettings maple() {
  SelfOrganizingSettings s;
  s.rate = 0.10, s.power = 1.2, s.internode = 0.22, s.vigour = 2.2, s.leader = 0.52;
  s.density = 0.045, s.falloff = 1.6, s.shadowDepth = 5;
  s.arrangement = BudArrangement::Opposite, s.buds = 2, s.angle = 42, s.light = 0.12, s.upward = 0.05;
  s.longestShoot = 5, s.pruning = 0.14, s.bole = 0.12, s.reach = 0.36;
  return s;
}

SelfOrganizingSettings pine() {
  SelfOrganizingSettings s;
  s.rate = 0.08, s.power = 1.3, s.internode = 0.30, s.vigour = 3.2, s.leader = 0.50, s.model = ResourceModel::Combined;
  s.density = 0.10, s.falloff = 1.5, s.shadowDepth = 6;
  s.arrangement = BudArrangement::Whorled, s.buds = 5, s.angle = 58, s.light = 0.14, s.upward = 0.20,
  s.longestShoot = 3;
  s.pruning = 0.22, s.leastWeight = 0.5, s.favoured = 1.0, s.bole = 0.55, s.reach = 0.27, s.level = 0.1, s.apical = 0.3;
  return s;
}

struct Shape {
  double height = 0, radius = 0;
};
Shape shapeOf(const Grown& grown) {
  Shape shape;
  for (const dvec3& p : grown.position) {
    shape.height = std::max(shape.height, p.y);
    shape.radius = std::max(shape.radius, std::hypot(p.x, p.z));
  }
  return shape;
}

SelfOrganized grownBy(const SelfOrganizingSettings& settings, double height, int years, quint64 seed) {
  Progress progress;
  return selfOrganize(settings, height, years, seed, {}, progress);
}

}  // namespace

class GrowSelfOrganizingTest : public QObject {
  Q_OBJECT
 private slots:
  void shadowsAreTheNotesAndLeaveNothingBehind();
  void borchertHondaSharesVigour();
  void priorityFavoursTheBrightest();
  void theMapleIsTheNotesMaple();
  void thePineKeepsItsUmbrella();
  void growthFollowsItsCurve();
  void leaderChoosesBetweenShrubAndTree();
  void prunedPlantsGrowOn();
  void theSameSeedGivesTheSameBits();
};

void GrowSelfOrganizingTest::shadowsAreTheNotesAndLeaveNothingBehind() {
  ShadowGrid grid(0.5, 6, 8, 0.2, 2, 4);
  grid.cast({0.1, 5, 0.2}, 1);
  QVERIFY(std::abs(grid.total() - 4.58750) < 1e-4);
  QVERIFY(std::abs(grid.shade({0.1, 5, 0.2}) - 0.2) < 1e-6);
  QVERIFY(std::abs(grid.shade({0.6, 4.5, 0.2}) - 0.1) < 1e-6);
  QCOMPARE(grid.shade({0.6, 5.6, 0.2}), 0.0);
  QVERIFY(grid.shade({100, 1, 0}) > 1);
  grid.cast({0.1, 5, 0.2}, -1);
  QCOMPARE(grid.total(), 0.0);
}

void GrowSelfOrganizingTest::borchertHondaSharesVigour() {
  const VigourShares even = borchertHonda(10, 2, 2, 0.5);
  QCOMPARE(even.main, 5.0);
  const VigourShares leading = borchertHonda(10, 1, 3, 0.75);
  QVERIFY(std::abs(leading.main - 10 * 0.75 / (0.75 + 0.75)) < 1e-12);
  QVERIFY(std::abs(leading.main + leading.lateral - 10) < 1e-12);
  QCOMPARE(borchertHonda(10, 0, 0, 0.5).main, 0.0);
}

void GrowSelfOrganizingTest::priorityFavoursTheBrightest() {
  SelfOrganizingSettings s;
  s.leastWeight = 0.25, s.favoured = 0.5, s.apical = 0;
  const std::vector<double> shares =
      byPriority(10, {{0.2, 1, false}, {0.9, 1, false}, {0.5, 1, false}, {0.5, 1, true}}, s);
  QVERIFY(shares[1] > shares[2] && shares[2] >= shares[3] && shares[3] > shares[0]);
  QVERIFY(std::abs(shares[0] + shares[1] + shares[2] + shares[3] - 10) < 1e-12);
  s.apical = 0.3;
  const std::vector<double> apical = byPriority(10, {{0.5, 1, false}, {0.5, 1, false}, {0.5, 1, true}}, s);
  QVERIFY(apical[2] > apical[0]);
}

void GrowSelfOrganizingTest::theMapleIsTheNotesMaple() {
  for (const quint64 seed : {25u, 3u}) {
    const SelfOrganized made = grownBy(maple(), 14, 20, seed);
    QVERIFY2(made.grown.size() > 9'000 && made.grown.size() < 23'000, qPrintable(QString::number(made.grown.size())));
    const double curve = grownHeight(maple(), 14, 20);
    QVERIFY(std::abs(curve - 11.76) < 0.02);
    QVERIFY2(std::abs(shapeOf(made.grown).height / curve - 1) < 0.05,
             qPrintable(QString::number(shapeOf(made.grown).height)));
  }
}

void GrowSelfOrganizingTest::thePineKeepsItsUmbrella() {
  for (const quint64 seed : {28u, 5u}) {
    const SelfOrganized made = grownBy(pine(), 16, 26, seed);
    const Shape shape = shapeOf(made.grown);
    QVERIFY2(made.grown.size() > 1'600 && made.grown.size() < 4'500, qPrintable(QString::number(made.grown.size())));
    QVERIFY2(std::abs(shape.height / grownHeight(pine(), 16, 26) - 1) < 0.05,
             qPrintable(QString::number(shape.height)));
    QVERIFY2(shape.radius > 2.4 && shape.radius < 4.4, qPrintable(QString::number(shape.radius)));
    // The bole is bare: what stands low stands near the axis.
    for (const dvec3& p : made.grown.position) {
      if (p.y < 0.3 * shape.height) QVERIFY(std::hypot(p.x, p.z) < 0.5 * shape.radius + 1.5);
    }
  }
}

void GrowSelfOrganizingTest::growthFollowsItsCurve() {
  double last = 0;
  for (const int years : {2, 5, 9, 14}) {
    const double height = shapeOf(grownBy(maple(), 14, years, 1).grown).height;
    QVERIFY(height >= last);
    QVERIFY(height <= grownHeight(maple(), 14, years) + 1e-6);
    last = height;
  }
}

void GrowSelfOrganizingTest::leaderChoosesBetweenShrubAndTree() {
  SelfOrganizingSettings shrub = maple(), tree = maple();
  shrub.leader = 0.42, tree.leader = 0.58;
  shrub.reach = tree.reach = 1;
  shrub.bole = tree.bole = 0;
  const Shape low = shapeOf(grownBy(shrub, 14, 12, 2).grown), tall = shapeOf(grownBy(tree, 14, 12, 2).grown);
  QVERIFY(low.radius / low.height > 1.1 * tall.radius / tall.height);
}

void GrowSelfOrganizingTest::prunedPlantsGrowOn() {
  Plant plant;
  plant.grower = GrowerSettings();
  plant.grower->method = GrowMethod::SelfOrganizing;
  plant.grower->selfOrganizing = maple();
  plant.grower->height = 14;
  plant.grower->age = 8;
  Progress progress;
  const Result<GrownSkeleton> young = growSkeleton(plant, progress);
  QVERIFY(young);
  // The trunk is cut at half its height.
  HandEdit cut;
  cut.age = 8;
  for (std::size_t i = 1; i < young->grown.size(); ++i) {
    const dvec3 p = young->grown.position[i];
    if (ordersOf(young->grown)[i] == 0 && p.y > 3) {
      cut.node = young->grown.source[i];
      cut.place = QVector3D(static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z));
      break;
    }
  }
  plant.handEdits = {cut};
  const Result<GrownSkeleton> stump = growSkeleton(plant, progress);
  QVERIFY(stump && stump->lost.empty());
  QVERIFY(stump->grown.size() < young->grown.size());
  plant.grower->age = 14;
  const Result<GrownSkeleton> old = growSkeleton(plant, progress);
  QVERIFY(old && old->grown.size() > stump->grown.size());
  plant.handEdits.clear();
  const Result<GrownSkeleton> uncut = growSkeleton(plant, progress);
  QVERIFY(uncut && uncut->grown.position != old->grown.position);
}

void GrowSelfOrganizingTest::theSameSeedGivesTheSameBits() {
  const SelfOrganized a = grownBy(maple(), 10, 10, 4), b = grownBy(maple(), 10, 10, 4), c = grownBy(maple(), 10, 10, 5);
  QVERIFY(a.grown.position == b.grown.position && a.grown.parent == b.grown.parent);
  QVERIFY(a.grown.position != c.grown.position);
}

WINDFALL_SUITE(GrowSelfOrganizingTest)
#include "grow_self_organizing.moc"
