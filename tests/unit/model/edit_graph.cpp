// Skeletons of files, shaped by hand.
#include "model/plant/grow/edit_graph.h"

#include <QtTest>

#include "model/plant/import.h"
#include "model/plant/prim_format.h"
#include "support/skeleton_data.h"
#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;

namespace {

HandEdit editAt(HandEditKind kind, vec3 place) {
  HandEdit edit;
  edit.kind = kind;
  edit.place = QVector3D(place.x, place.y, place.z);
  return edit;
}

/// Segments that grow from `top`, itself among them.
int carried(const SkeletonGraph& graph, std::size_t top) {
  std::vector<char> inside(graph.segments.size(), 0);
  int count = 0;
  for (std::size_t i = top; i < inside.size(); ++i) {
    const std::int32_t parent = graph.segments[i].parent;
    inside[i] = i == top || (parent >= 0 && inside[static_cast<std::size_t>(parent)]);
    count += inside[i];
  }
  return count;
}

}  // namespace

class EditGraphTest : public QObject {
  Q_OBJECT

  SkeletonGraph tree_ = test::smallTree(5);

 private slots:
  void initTestCase() {
    for (Segment& s : tree_.segments) s.state.water = 0.25f;
  }

  void noEditsChangeNothing() { QVERIFY(growth::withEdits(tree_, {}) == tree_); }

  void pruningTakesTheBranchItsLeavesAndItsBudAway() {
    // The third link of the stem, with all above it.
    const std::size_t cut = 10;
    std::vector<int> lost;
    const SkeletonGraph pruned = growth::withEdits(tree_, {editAt(HandEditKind::Prune, tree_.segments[cut].b)}, &lost);
    QVERIFY(lost.empty());
    QCOMPARE(static_cast<int>(pruned.segments.size()), static_cast<int>(tree_.segments.size()) - carried(tree_, cut));
    QVERIFY(pruned.leaves.size() < tree_.leaves.size() && !pruned.leaves.empty());
    QVERIFY(pruned.buds.empty());
    for (std::size_t i = 0; i < pruned.segments.size(); ++i) {
      QVERIFY(pruned.segments[i].parent < static_cast<std::int32_t>(i));
      QCOMPARE(pruned.segments[i].state.water, 0.25f);
      QVERIFY(glm::length(pruned.segments[i].b - tree_.segments[i].b) < 1e-6f);
    }
  }

  void bendingTurnsWhatIsCarriedAndKeepsLengths() {
    const std::size_t from = 3;
    HandEdit bend = editAt(HandEditKind::Bend, tree_.segments[from].b);
    bend.axis = {0, 0, 1};
    bend.angle = 40;
    const SkeletonGraph bent = growth::withEdits(tree_, {bend});
    QCOMPARE(bent.segments.size(), tree_.segments.size());
    bool moved = false;
    for (std::size_t i = 0; i < bent.segments.size(); ++i) {
      const Segment &is = bent.segments[i], &was = tree_.segments[i];
      QVERIFY(std::abs(glm::length(is.b - is.a) - glm::length(was.b - was.a)) < 1e-5f);
      if (is.parent >= 0) QVERIFY(glm::length(is.a - bent.segments[static_cast<std::size_t>(is.parent)].b) < 1e-5f);
      moved = moved || glm::length(is.b - was.b) > 0.2f;
    }
    QVERIFY(moved);
    for (std::size_t l = 0; l < bent.leaves.size(); ++l) {
      QVERIFY(std::abs(glm::length(bent.leaves[l].tip - bent.leaves[l].base) -
                       glm::length(tree_.leaves[l].tip - tree_.leaves[l].base)) < 1e-5f);
    }
  }

  void drawnBranchesGrowFromTheirPlace() {
    const std::size_t from = 3;
    HandEdit draw = editAt(HandEditKind::Draw, tree_.segments[from].b);
    const vec3 end = tree_.segments[from].b + vec3(0.5f, 0.3f, 0);
    draw.line = {QVector3D(end.x - 0.2f, end.y - 0.1f, end.z), QVector3D(end.x, end.y, end.z)};
    const SkeletonGraph drawn = growth::withEdits(tree_, {draw});
    QCOMPARE(drawn.segments.size(), tree_.segments.size() + 2);
    const Segment &first = drawn.segments[tree_.segments.size()], &last = drawn.segments.back();
    QCOMPARE(first.parent, static_cast<std::int32_t>(from));
    QCOMPARE(last.parent, static_cast<std::int32_t>(tree_.segments.size()));
    QVERIFY(glm::length(last.b - end) < 1e-5f);
    QVERIFY(first.ra <= drawn.segments[from].rb * 1.21f && last.rb < first.ra);
    QCOMPARE(first.state.water, 0.25f);
  }

  void thickeningLeavesTheRestAsItIs() {
    HandEdit thicken = editAt(HandEditKind::Thicken, tree_.segments[1].b);
    thicken.factor = 1.5;
    const SkeletonGraph thick = growth::withEdits(tree_, {thicken});
    QVERIFY(std::abs(thick.segments[1].rb - 1.5f * tree_.segments[1].rb) < 1e-6f);
    QVERIFY(std::abs(thick.segments[3].rb - tree_.segments[3].rb) < 1e-6f);
  }

  void editsWithoutAPlaceAreTold() {
    std::vector<int> lost;
    const SkeletonGraph same = growth::withEdits(tree_, {editAt(HandEditKind::Prune, {30, 5, 2})}, &lost);
    QCOMPARE(lost, std::vector<int>{0});
    QCOMPARE(same.segments.size(), tree_.segments.size());
  }

  void plantsOfFilesAreShapedWhenTheyAreLoaded() {
    Plant plant;
    plant.file = {QStringLiteral("tree.prim"), *writePrim(tree_, 4)};
    Progress progress;
    const Result<PlantGeometry> whole = loadGeometry(plant, progress);
    QVERIFY(whole);
    plant.handEdits = {editAt(HandEditKind::Prune, tree_.segments[10].b), editAt(HandEditKind::Prune, {30, 5, 2})};
    const Result<PlantGeometry> pruned = loadGeometry(plant, progress);
    QVERIFY(pruned);
    QVERIFY(pruned->bones.size() < whole->bones.size());
    QVERIFY(pruned->notes.join(' ').contains("edit 2 found no branch"));
    // Edits are kept in the file's own size.
    plant.surface.scale = 3;
    QCOMPARE(loadGeometry(plant, progress)->bones.size(), pruned->bones.size());
  }
};

WINDFALL_SUITE(EditGraphTest)
#include "edit_graph.moc"
