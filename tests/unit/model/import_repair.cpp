// Skeletons that are no trees, damaged ones, huge ones, and clips inside files.
#include "model/plant/import_repair.h"

#include <QElapsedTimer>
#include <QTest>

#include "model/plant/bodies.h"
#include "model/plant/foliage.h"
#include "model/plant/import.h"
#include "sim/bodies.h"
#include "sim/self_buckling.h"
#include "support/gltf_fixture.h"
#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;

namespace {

Result<PlantGeometry> import(const QByteArray& bytes, const char* name = "plant.glb") {
  Plant plant;
  plant.file = {name, bytes};
  Progress progress;
  return loadGeometry(plant, progress);
}

QString errorOf(const Result<PlantGeometry>& read) {
  return read ? QString() : QString::fromStdString(read.error().message);
}

/// The tube of the fixture on `count` joints: joint i hangs on parentOf(i) and stands at 1 m above it.
template <class Parent, class Name>
test::GltfFixture jointed(int count, Parent parentOf, Name nameOf) {
  test::GltfFixture fixture;
  std::vector<QJsonArray> children(static_cast<std::size_t>(count));
  std::vector<float> height(static_cast<std::size_t>(count), 0.f);
  for (int i = 1; i < count; ++i) {
    children[static_cast<std::size_t>(parentOf(i))].append(2 + i);
    height[static_cast<std::size_t>(i)] = height[static_cast<std::size_t>(parentOf(i))] + 1;
  }
  QJsonArray nodes{QJsonObject{{"name", "rig"}, {"children", QJsonArray{1, 2}}},
                   QJsonObject{{"name", "body"}, {"mesh", 0}, {"skin", 0}}};
  QJsonArray joints;
  std::vector<float> binds;
  for (int i = 0; i < count; ++i) {
    QJsonObject node{{"name", nameOf(i)}};
    if (i > 0) node["translation"] = QJsonArray{0, 1, 0};
    if (!children[static_cast<std::size_t>(i)].isEmpty()) node["children"] = children[static_cast<std::size_t>(i)];
    nodes.append(node);
    joints.append(2 + i);
    binds.insert(binds.end(), {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -height[static_cast<std::size_t>(i)], 0, 1});
  }
  const int matrices =
      fixture.add(binds.data(), static_cast<qsizetype>(binds.size() * sizeof(float)), 5126, "MAT4", count);
  fixture.root["nodes"] = nodes;
  fixture.root["skins"] = QJsonArray{QJsonObject{{"joints", joints}, {"inverseBindMatrices", matrices}}};
  return fixture;
}

}  // namespace

class ImportRepairTest : public QObject {
  Q_OBJECT
 private slots:
  void clipsOfTheFileAreKeptAndPlay() {
    test::GltfFixture fixture;
    const float times[] = {0, 0.5f, 1};
    const quat bent = glm::angleAxis(glm::radians(30.f), vec3(0, 0, 1));
    const float turns[] = {0, 0, 0, 1, bent.x, bent.y, bent.z, bent.w, 0, 0, 0, 1};
    const int input = fixture.add(times, sizeof times, 5126, "SCALAR", 3);
    const int output = fixture.add(turns, sizeof turns, 5126, "VEC4", 3);
    fixture.root["animations"] = QJsonArray{QJsonObject{
        {"name", "Sway"},
        {"samplers", QJsonArray{QJsonObject{{"input", input}, {"output", output}}}},
        {"channels",
         QJsonArray{QJsonObject{{"sampler", 0}, {"target", QJsonObject{{"node", 3}, {"path", "rotation"}}}}}}}};
    const auto geometry = import(fixture.glb());
    QVERIFY2(geometry, qPrintable(errorOf(geometry)));
    QCOMPARE(geometry->clips.size(), std::size_t{1});
    const Clip& clip = geometry->clips.front();
    QCOMPARE(clip.name, QString("Sway"));
    QVERIFY(std::abs(clip.length - 1) < 1e-6);
    QVERIFY(clip.looping);
    QVERIFY(clip.origin == ClipOrigin::Imported);
    const auto rest = poseAt(clip, geometry->bones, 0), half = poseAt(clip, geometry->bones, 0.5);
    const vec3 tip(half[1] * vec4(0, 2, 0, 1));
    QVERIFY(glm::length(vec3(rest[1] * vec4(0, 2, 0, 1)) - vec3(0, 2, 0)) < 1e-4f);
    QVERIFY(glm::length(tip - vec3(-0.5f, 1 + std::cos(glm::radians(30.f)), 0)) < 1e-3f);
    QVERIFY(glm::length(vec3(half[0] * vec4(0, 1, 0, 1)) - vec3(0, 1, 0)) < 1e-4f);
  }

  void clipsOfATurnedAndScaledRigAreInPlantSpace() {
    test::GltfFixture fixture;
    const float times[] = {0, 1};
    const quat bent = glm::angleAxis(glm::radians(40.f), vec3(1, 0, 0));
    const float turns[] = {0, 0, 0, 1, bent.x, bent.y, bent.z, bent.w};
    const int input = fixture.add(times, sizeof times, 5126, "SCALAR", 2);
    const int output = fixture.add(turns, sizeof turns, 5126, "VEC4", 2);
    fixture.root["animations"] = QJsonArray{QJsonObject{
        {"samplers", QJsonArray{QJsonObject{{"input", input}, {"output", output}}}},
        {"channels",
         QJsonArray{QJsonObject{{"sampler", 0}, {"target", QJsonObject{{"node", 3}, {"path", "rotation"}}}}}}}};
    // A quarter turn about y and twice the size.
    fixture.set("nodes", 0, "rotation", QJsonArray{0, 0.70710678, 0, 0.70710678});
    fixture.set("nodes", 0, "scale", QJsonArray{2, 2, 2});
    const auto geometry = import(fixture.glb());
    QVERIFY2(geometry, qPrintable(errorOf(geometry)));
    QCOMPARE(geometry->clips.size(), std::size_t{1});
    QVERIFY(!geometry->clips.front().looping);
    const auto pose = poseAt(geometry->clips.front(), geometry->bones, 1);
    const vec3 joint = geometry->bones[1].head;
    QVERIFY(glm::length(joint - vec3(0, 2, 0)) < 1e-4f);
    const vec3 tip = vec3(pose[1] * vec4(0, 4, 0, 1)) - joint;
    // About the rig's x, which the turn brings to -z: the tip goes to +x.
    QVERIFY2(glm::length(tip - 2.f * vec3(std::sin(glm::radians(40.f)), std::cos(glm::radians(40.f)), 0)) < 2e-3f,
             qPrintable(QString("%1 %2 %3").arg(double(tip.x)).arg(double(tip.y)).arg(double(tip.z))));
  }

  void verticesThatNoBoneHoldsFollowWhatIsNearest() {
    // The last ring of the tube, at 2 m, lets go of the upper bone.
    test::GltfFixture fixture;
    const QJsonObject mesh = fixture.root["meshes"].toArray()[0].toObject();
    const QJsonObject tube = mesh["primitives"].toArray()[0].toObject();
    const int accessor = tube["attributes"].toObject()["WEIGHTS_0"].toInt();
    const int view = fixture.root["accessors"].toArray()[accessor].toObject()["bufferView"].toInt();
    const auto weights = fixture.root["bufferViews"].toArray()[view].toObject()["byteOffset"].toInt();
    for (int v = 16; v < 20; ++v) {
      for (int k = 0; k < 4; ++k) fixture.setFloat(weights + 16 * v + 4 * k, 0);
    }
    const auto geometry = import(fixture.glb());
    QVERIFY2(geometry, qPrintable(errorOf(geometry)));
    QCOMPARE(geometry->notes, QStringList{"4 vertices were held by no bone and follow what is nearest"});
    int top = 0;
    for (const Vertex& vertex : geometry->vertices) {
      if (vertex.position.y < 1.9f) continue;
      QCOMPARE(vertex.bones[0], 1u);
      QCOMPARE(vertex.weights[0], 1.f);
      ++top;
    }
    QCOMPARE(top, 4);
  }

  void leavesThatShareTheMaterialOfTheWoodAreLeavesAndTheWoodIsWood() {
    PlantGeometry geometry;
    geometry.materials.emplace_back();
    const auto triangle = [&](const vec3& a, const vec3& b, const vec3& c) {
      for (const vec3& p : {a, b, c}) {
        Vertex vertex{};
        vertex.position = p;
        geometry.indices.push_back(static_cast<std::uint32_t>(geometry.vertices.size()));
        geometry.vertices.push_back(vertex);
      }
    };
    const auto endPart = [&] {
      MeshPart part;
      part.firstIndex =
          geometry.parts.empty() ? 0 : geometry.parts.back().firstIndex + geometry.parts.back().indexCount;
      part.indexCount = static_cast<std::uint32_t>(geometry.indices.size()) - part.firstIndex;
      geometry.parts.push_back(part);
    };
    for (int i = 0; i < 60; ++i) {
      const auto y = 0.1f * static_cast<float>(i);
      triangle({0, y, 0}, {0, y + 0.1f, 0}, {0.1f, y, 0});
    }
    endPart();
    for (int i = 0; i < 40; ++i) {
      const auto y = 0.1f * static_cast<float>(i);
      triangle({1, y, 0}, {1.05f, y, 0}, {1, y + 0.05f, 0});
    }
    endPart();
    detectFoliage(geometry);
    QCOMPARE(geometry.materials.size(), std::size_t{2});
    QVERIFY(!geometry.materials[static_cast<std::size_t>(geometry.parts[0].material)].leaf);
    QVERIFY(geometry.materials[static_cast<std::size_t>(geometry.parts[1].material)].leaf);
  }

  void aFigureIsNoTree() {
    const QStringList names{"mixamorig:Hips",    "mixamorig:Spine",    "mixamorig:Neck",    "mixamorig:Head",
                            "mixamorig:LeftArm", "mixamorig:LeftHand", "mixamorig:LeftFoot"};
    const auto fixture = jointed(
        7, [](int i) { return i - 1; }, [&](int i) { return names[i]; });
    const QString error = errorOf(import(fixture.glb()));
    QVERIFY2(error.startsWith("is the skeleton of a figure"), qPrintable(error));
    QVERIFY(!error.contains('\n'));
  }

  void treesWithCommonNamesAreTrees() {
    const QStringList names{"trunk", "arm_left", "limb_head", "branch.001", "spine_twig", "leaf_hand", "root"};
    const auto fixture = jointed(
        7, [](int i) { return i - 1; }, [&](int i) { return names[i]; });
    const auto read = import(fixture.glb());
    QVERIFY2(read, qPrintable(errorOf(read)));
  }

  void bonesInOnePlaceAreNamed() {
    test::GltfFixture fixture = jointed(
        4, [](int i) { return i - 1; }, [](int i) { return QString("b%1").arg(i); });
    QJsonArray nodes = fixture.root["nodes"].toArray();
    for (int i = 3; i < 6; ++i) {
      QJsonObject node = nodes[i].toObject();
      node.remove("translation");
      nodes[i] = node;
    }
    fixture.root["nodes"] = nodes;
    std::vector<float> binds;
    for (int i = 0; i < 4; ++i) binds.insert(binds.end(), {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
    const int matrices = fixture.add(binds.data(), qsizetype(binds.size() * 4), 5126, "MAT4", 4);
    fixture.set("skins", 0, "inverseBindMatrices", matrices);
    QCOMPARE(errorOf(import(fixture.glb())), QString("has all its bones in one place: they do not follow the tree"));
  }

  void twoRootsStandSideBySideAndAreTold() {
    test::GltfFixture fixture;
    fixture.set("nodes", 0, "children", QJsonArray{1, 2, 3});
    QJsonArray nodes = fixture.root["nodes"].toArray();
    QJsonObject lower = nodes[2].toObject();
    lower.remove("children");
    nodes[2] = lower;
    fixture.root["nodes"] = nodes;
    const auto geometry = import(fixture.glb());
    QVERIFY2(geometry, qPrintable(errorOf(geometry)));
    QVERIFY2(geometry->notes.join(';').contains("2 roots"), qPrintable(geometry->notes.join(';')));
    const PlantBodies bodies = buildBodies(*geometry, {});
    QVERIFY(sim::problemOf(bodies.tree).empty());
    QCOMPARE(bodies.tree.links.size(), std::size_t{2});
  }

  void aBoneOfNoLengthAndOneOfNoThicknessAreMendedAndTold() {
    PlantGeometry geometry;
    geometry.bones = {{"a", -1, {0, 0, 0}, {0, 1, 0}, 0.1f},
                      {"b", 0, {0, 1, 0}, {0, 1, 0}, 0.05f},
                      {"c", 1, {0, 1, 0}, {0, 2, 0}, 0},
                      {"d", 2, {0, 2, 0}, {0, 3, 0}, std::nanf("")}};
    mendBones(geometry);
    QVERIFY(std::abs(geometry.bones[2].radius - 0.035f) < 1e-6f);
    QVERIFY(geometry.bones[3].radius > 0);
    const QString told = geometry.notes.join("; ");
    QVERIFY2(told.contains("one bone is too short") && told.contains("2 bones have no thickness"), qPrintable(told));
    const PlantBodies bodies = buildBodies(geometry, {});
    QVERIFY(sim::problemOf(bodies.tree).empty());
    QCOMPARE(bodies.tree.links.size(), std::size_t{3});
  }

  void aColumnBucklesWhereGreenhillSaysSo() {
    // m g L^2 = 7.837 E I for a uniform column: the share of the load is its inverse.
    sim::Tree column;
    constexpr int kLinks = 24;
    constexpr float kLength = 12, kRadius = 0.03f;
    for (int i = 0; i < kLinks; ++i) {
      sim::Link link;
      link.parent = i - 1;
      link.joint = vec3(0, kLength * float(i) / kLinks, 0);
      link.rotation = glm::angleAxis(-1.57079633f, vec3(1, 0, 0));
      link.length = kLength / kLinks;
      link.radius = kRadius;
      column.links.push_back(link);
    }
    const double area = 3.14159265 * double(kRadius) * double(kRadius);
    const double load = 950 * area * double(kLength) * 9.81 * double(kLength) * double(kLength);
    const double bending = 7.837 * 6e9 * area * double(kRadius) * double(kRadius) / 4;
    const double share = sim::selfBuckling(column);
    QVERIFY2(std::abs(share / (load / bending) - 1) < 0.03,
             qPrintable(QString("%1 of %2").arg(share).arg(load / bending)));
    // The same hanging from above is held by its weight.
    for (sim::Link& link : column.links) {
      link.joint.y = -link.joint.y;
      link.rotation = glm::angleAxis(1.57079633f, vec3(1, 0, 0));
    }
    QVERIFY(sim::selfBuckling(column) < 1e-6);
  }
};

WINDFALL_SUITE(ImportRepairTest)
#include "import_repair.moc"
