// Bones become branches and links: order, parameters, leaves, the artist's edits.
#include "model/plant/bodies.h"

#include <QtTest>
#include <algorithm>
#include <cmath>

#include "model/plant/grower.h"
#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;

namespace {

Bone bone(const char* name, int parent, vec3 head, vec3 tail, float radius) {
  return {QString(name), parent, head, tail, radius, true};
}

/// A trunk of three bones, a long limb in the middle of the second, a short one at the end of the first.
std::vector<Bone> smallTree() {
  return {
      bone("trunk.000", -1, {0, 0, 0}, {0, 1, 0}, 0.1f),       bone("trunk.001", 0, {0, 1, 0}, {0, 2, 0}, 0.09f),
      bone("short.000", 0, {0, 1, 0}, {0.3f, 1.2f, 0}, 0.02f), bone("trunk.002", 1, {0, 2, 0}, {0, 3, 0}, 0.06f),
      bone("long.000", 1, {0, 1.5f, 0}, {2, 1.5f, 0}, 0.05f),  bone("long.001", 4, {2, 1.5f, 0}, {4, 1.5f, 0}, 0.03f)};
}

PlantGeometry grown() {
  Progress progress;
  GrowerSettings settings;
  settings.limbs = 8;
  return *grow(settings, progress);
}

double leafArea(const sim::Tree& tree) {
  double sum = 0;
  for (const sim::Link& link : tree.links) sum += static_cast<double>(link.leafArea);
  return sum;
}

}  // namespace

class PlantBodiesTest : public QObject {
  Q_OBJECT
 private slots:
  void branchesFollowTheGreatestLength();
  void theOrderOfSiblingsDoesNotMatter();
  void linksArePreorderWithWholeSubtrees();
  void linksCarryTheRestPose();
  void leafAreaFollowsTheTrunkAndHangsOnTerminalBranches();
  void bonesWithoutLengthGiveTheirChildrenToTheirParent();
  void editsReachTheirLinkByName();
  void leafDensityScalesSitesAndArea();
  void wiresAndNecksAreMadeToStand();
};

void PlantBodiesTest::branchesFollowTheGreatestLength() {
  const std::vector<Branch> branches = findBranches(smallTree());
  QCOMPARE(branches.size(), std::size_t(3));
  QCOMPARE(branches[0].name, QString("trunk"));
  // The long limb is longer than the rest of the trunk but starts in the middle of a bone: it continues nothing.
  QCOMPARE(branches[0].bones, (std::vector<int>{0, 1, 3}));
  QCOMPARE(branches[0].length, 3.0);
  QCOMPARE(branches[0].order, 0);
  const auto limb = std::find_if(branches.begin(), branches.end(), [](const Branch& b) { return b.name == "long"; });
  QVERIFY(limb != branches.end());
  QCOMPARE(limb->bones, (std::vector<int>{4, 5}));
  QCOMPARE(limb->parent, 0);
  QCOMPARE(limb->order, 1);
}

void PlantBodiesTest::theOrderOfSiblingsDoesNotMatter() {
  std::vector<Bone> fork{bone("a", -1, {0, 0, 0}, {0, 1, 0}, 0.1f), bone("left", 0, {0, 1, 0}, {-1, 2, 0}, 0.05f),
                         bone("right", 0, {0, 1, 0}, {1, 2, 0}, 0.05f)};
  const auto continues = [](const std::vector<Bone>& bones) {
    return bones[static_cast<std::size_t>(findBranches(bones)[0].bones.back())].name;
  };
  const QString first = continues(fork);
  std::swap(fork[1], fork[2]);
  QCOMPARE(continues(fork), first);
}

void PlantBodiesTest::linksArePreorderWithWholeSubtrees() {
  const PlantGeometry plant = grown();
  const PlantBodies bodies = buildBodies(plant, Plant{});
  const std::vector<sim::Link>& links = bodies.tree.links;
  QCOMPARE(links.size(), plant.bones.size());
  std::vector<int> below(links.size(), 1);
  for (std::size_t i = links.size(); i-- > 0;) {
    QVERIFY(links[i].parent < static_cast<int>(i));
    if (links[i].parent >= 0) below[static_cast<std::size_t>(links[i].parent)] += below[i];
    QCOMPARE(bodies.linkOfBone[static_cast<std::size_t>(bodies.boneOfLink[i])], static_cast<int>(i));
  }
  for (std::size_t i = 1; i < links.size(); ++i) {
    // Contiguous subtrees: a link lies inside the run of its parent.
    const auto parent = static_cast<std::size_t>(links[i].parent);
    QVERIFY(i < parent + static_cast<std::size_t>(below[parent]));
  }
}

void PlantBodiesTest::linksCarryTheRestPose() {
  PlantGeometry plant;
  plant.bones = smallTree();
  const PlantBodies bodies = buildBodies(plant, Plant{});
  for (std::size_t i = 0; i < bodies.tree.links.size(); ++i) {
    const sim::Link& link = bodies.tree.links[i];
    const Bone& source = plant.bones[static_cast<std::size_t>(bodies.boneOfLink[i])];
    QVERIFY(glm::length(link.joint - source.head) < 1e-6f);
    QVERIFY(glm::length(link.joint + link.rotation * vec3(0, 0, link.length) - source.tail) < 1e-5f);
    QCOMPARE(link.woodDensity, 950.f);
    QCOMPARE(link.youngsModulus, 6e9f);
  }
}

void PlantBodiesTest::leafAreaFollowsTheTrunkAndHangsOnTerminalBranches() {
  PlantGeometry plant;
  plant.bones = smallTree();
  const PlantBodies bodies = buildBodies(plant, Plant{});
  QVERIFY(std::abs(leafArea(bodies.tree) / (2000 * 3.14159265 * 0.1 * 0.1) - 1) < 1e-3);
  double onLong = 0, onShort = 0;
  for (const sim::Link& link : bodies.tree.links) {
    const QString& name = bodies.branches[static_cast<std::size_t>(link.chain)].name;
    if (name == "trunk") QCOMPARE(link.leafArea, 0.f);
    (name == "long" ? onLong : onShort) += static_cast<double>(link.leafArea);
  }
  // Shared by the square of the base radius: 5 to 2.
  QVERIFY(std::abs(onLong / onShort - 6.25) < 1e-3);
  QVERIFY(!bodies.tree.sites.empty());
}

void PlantBodiesTest::bonesWithoutLengthGiveTheirChildrenToTheirParent() {
  PlantGeometry plant;
  plant.bones = smallTree();
  plant.bones[1].tail = plant.bones[1].head;
  const PlantBodies bodies = buildBodies(plant, Plant{});
  QCOMPARE(bodies.tree.links.size(), std::size_t(5));
  QCOMPARE(bodies.linkOfBone[1], -1);
  QCOMPARE(bodies.carrierOfBone[1], bodies.linkOfBone[0]);
  QCOMPARE(bodies.tree.links[static_cast<std::size_t>(bodies.linkOfBone[4])].parent, bodies.linkOfBone[0]);
}

void PlantBodiesTest::editsReachTheirLinkByName() {
  PlantGeometry plant;
  plant.bones = smallTree();
  Plant edited;
  LinkAttributes soft;
  soft.stiffness = 0.25;
  soft.windResponse = 2;
  soft.woodDensity = 700;
  edited.edits["long.001"] = soft;
  edited.edits["gone.000"] = soft;
  const PlantBodies before = buildBodies(plant, Plant{}), after = buildBodies(plant, edited);
  const auto link = static_cast<std::size_t>(after.linkOfBone[5]);
  QCOMPARE(after.tree.links[link].stiffnessScale, 0.25f);
  QCOMPARE(after.tree.links[link].windScale, 2.f);
  QCOMPARE(after.tree.links[link].woodDensity, 700.f);
  for (std::size_t i = 0; i < after.tree.links.size(); ++i) {
    QCOMPARE(after.tree.links[i].radius, before.tree.links[i].radius);
    if (i != link) QCOMPARE(after.tree.links[i].stiffnessScale, 1.f);
  }
}

void PlantBodiesTest::leafDensityScalesSitesAndArea() {
  const PlantGeometry plant = grown();
  const auto with = [&](double density) {
    Plant thinned;
    thinned.leafDensity = density;
    return buildBodies(plant, thinned, 3, 4);
  };
  const PlantBodies whole = with(1), half = with(0.5), more = with(2.5), none = with(0);
  const auto sites = static_cast<double>(whole.tree.sites.size());
  QCOMPARE(whole.tree.sites.size(), plant.leafSites.size());
  QVERIFY(std::abs(static_cast<double>(half.tree.sites.size()) / sites - 0.5) < 0.03);
  QVERIFY(std::abs(static_cast<double>(more.tree.sites.size()) / sites - 2.5) < 0.06);
  QVERIFY(none.tree.sites.empty());
  QVERIFY(std::abs(leafArea(half.tree) / leafArea(whole.tree) - 0.5) < 1e-4);
  for (const sim::LeafSite& site : whole.tree.sites) QVERIFY(site.layer >= 3 && site.layer < 7);
}

void PlantBodiesTest::wiresAndNecksAreMadeToStand() {
  PlantGeometry plant;
  plant.bones = smallTree();
  plant.bones[4].radius = 0.002f;  // 4 m of limb on 2 mm
  plant.bones[3].radius = 0.06f;
  const PlantBodies bodies = buildBodies(plant, Plant{});
  const auto radius = [&](std::size_t b) {
    return bodies.tree.links[static_cast<std::size_t>(bodies.linkOfBone[b])].radius;
  };
  QVERIFY(radius(4) >= radius(5) && radius(4) > 0.02f);
  // What stands on its own is left as it is.
  QCOMPARE(radius(0), 0.1f);
  QCOMPARE(radius(3), 0.06f);
  QVERIFY(sim::firstFrequency(bodies.tree) > 0.2);
}

WINDFALL_SUITE(PlantBodiesTest)
#include "plant_bodies.moc"
