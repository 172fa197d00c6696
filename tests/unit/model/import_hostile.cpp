// Skeletons of a hundred thousand bones, and FBX files that would take Assimp down: each opens in seconds or says in
// one line what is wrong.
#include <QTest>
#include <limits>

#include "model/plant/bodies.h"
#include "model/plant/fbx_check.h"
#include "model/plant/hierarchy.h"
#include "model/plant/import.h"
#include "sim/bodies.h"
#include "support/bone_forest_fixture.h"
#include "support/fbx_binary_fixture.h"
#include "support/fbx_fixture.h"
#include "support/gltf_fixture.h"
#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;

namespace {

Result<PlantGeometry> import(const QByteArray& bytes, const char* name) {
  Plant plant;
  plant.file = {name, bytes};
  Progress progress;
  return loadGeometry(plant, progress);
}

template <class T>
QString errorOf(const Result<T>& read) {
  return read ? QString() : QString::fromStdString(read.error().message);
}

/// Two models one of which hangs on the other, and what else is connected.
QByteArray fbxWith(const std::vector<std::pair<qint64, qint64>>& connections) {
  test::FbxRecord objects("Objects"), links("Connections");
  for (const qint64 id : {11, 12}) {
    test::FbxRecord& model = objects.add(test::FbxRecord("Model"));
    model.id(id).object("joint" + QByteArray::number(id), "Model").text("LimbNode");
  }
  for (const auto& [from, to] : connections) links.add(test::FbxRecord("C")).text("OO").id(from).id(to);
  return test::fbxBinary({objects, links});
}

}  // namespace

class ImportHostileTest : public QObject {
  Q_OBJECT
 private slots:
  void aHundredThousandBonesOpen_data() {
    QTest::addColumn<QString>("format");
    QTest::addColumn<int>("bones");
    QTest::addColumn<int>("fanOut");
    QTest::newRow("bushy glTF") << "glb" << 100'000 << 3;
    QTest::newRow("glTF in one chain") << "glb" << 100'000 << 1;
    QTest::newRow("glTF all on one bone") << "glb" << 20'000 << 20'000;
    QTest::newRow("bushy FBX") << "fbx" << 20'000 << 3;
    QTest::newRow("FBX in one chain") << "fbx" << 30'000 << 1;
  }

  void aHundredThousandBonesOpen() {
    QFETCH(QString, format);
    QFETCH(int, bones);
    QFETCH(int, fanOut);
    const test::BoneForest forest(bones, fanOut);
    const bool fbx = format == QLatin1String("fbx");
    const auto geometry = import(fbx ? test::fbxOf(forest) : test::gltfOf(forest), fbx ? "many.fbx" : "many.glb");
    QVERIFY2(geometry, qPrintable(errorOf(geometry)));
    QCOMPARE(geometry->bones.size(), static_cast<std::size_t>(bones));
    float apart = 0;
    for (std::size_t b = 0; b < geometry->bones.size(); ++b) {
      const auto own = geometry->bones[b].name.mid(4).toULongLong();
      apart = std::max(apart, glm::length(geometry->bones[b].head - forest.head[own]));
    }
    QVERIFY2(apart < 1e-3f, qPrintable(QString::number(double(apart))));
    const PlantBodies bodies = buildBodies(*geometry, {});
    QCOMPARE(bodies.tree.links.size(), static_cast<std::size_t>(bones));
    QCOMPARE(QString::fromStdString(sim::problemOf(bodies.tree)), QString());
    if (fanOut == 1) QCOMPARE(bodies.branches.size(), std::size_t{1});
  }

  void bonesAllTooShortToBendAreToldOnceAndQuickly() {
    // A chain of bones each of which is far thicker than long: none becomes a link.
    PlantGeometry geometry;
    for (int i = 0; i < 50'000; ++i) {
      const float y = 1e-3f * float(i);
      geometry.bones.push_back({QString::number(i), i - 1, {0, y, 0}, {0, y + 1e-3f, 0}, 0.1f});
    }
    const PlantBodies bodies = buildBodies(geometry, {});
    QVERIFY(bodies.tree.links.empty());
  }

  void levelsAreCountedAndLimited() {
    const auto name = [](std::size_t i) { return "node " + std::to_string(i); };
    QCOMPARE(*levelsOf({}, name), 0);
    QCOMPARE(*levelsOf({-1, 0, 0, 2, -1}, name), 3);
    QCOMPARE(*levelsOf({1, 2, -1}, name), 3);
    QCOMPARE(errorOf(levelsOf({-1, 2, 1}, name)), QString("node 1 is its own ancestor"));
    std::vector<std::ptrdiff_t> chain(kMostLevels + 1);
    for (std::size_t i = 0; i < chain.size(); ++i) chain[i] = static_cast<std::ptrdiff_t>(i) - 1;
    QVERIFY(errorOf(levelsOf(chain, name)).contains("150,000 levels deep"));
    chain.pop_back();
    QCOMPARE(*levelsOf(chain, name), kMostLevels);
  }

  void nodesOfFbxThatFormNoTreeAreNamed() {
    QCOMPARE(*checkFbx(fbxWith({{11, 0}, {12, 11}})), 2);
    QCOMPARE(errorOf(checkFbx(fbxWith({{11, 12}, {12, 11}}))), QString("node \"joint11\" is its own ancestor"));
    QCOMPARE(errorOf(checkFbx(fbxWith({{11, 11}}))), QString("node \"joint11\" is its own ancestor"));
    QCOMPARE(errorOf(checkFbx(fbxWith({{11, 0}, {12, 11}, {12, 0}}))), QString("node \"joint12\" has two parents"));
    // Clusters hang on bones too, and are no nodes.
    QCOMPARE(*checkFbx(fbxWith({{11, 0}, {12, 11}, {11, 500}, {500, 501}, {501, 12}})), 2);

    QByteArray text = test::fbxFixture(1, 1);
    QCOMPARE(*checkFbx(text), 2);
    QCOMPARE(errorOf(import(QByteArray(text).replace("\"OO\",30,0", "\"OO\",30,31"), "p.fbx")),
             QString("node \"lower\" is its own ancestor"));
    QCOMPARE(errorOf(import(QByteArray(text).replace("\"OO\",20,0", "\"OO\",31,0"), "p.fbx")),
             QString("node \"upper\" has two parents"));
  }

  void recordsWithinRecordsWithoutEndAreRefused() {
    test::FbxRecord nested("a");
    for (int i = 0; i < 100; ++i) {
      test::FbxRecord outer("a");
      outer.add(std::move(nested));
      nested = std::move(outer);
    }
    QVERIFY(errorOf(checkFbx(test::fbxBinary({nested}))).contains("64 deep"));
    QVERIFY(errorOf(checkFbx("Objects: {\n" + QByteArray("a: {\n").repeated(100'000))).contains("64 deep"));
  }

  void aTruncatedFbxGivesOneClearLine() {
    const QByteArray whole = test::fbxOf(test::BoneForest(5, 2));
    const auto read = import(whole, "p.fbx");
    QVERIFY2(read, qPrintable(errorOf(read)));
    for (qsizetype size = 1; size + 40 < whole.size(); size += 61) {
      const QString error = errorOf(import(whole.left(size), "p.fbx"));
      QVERIFY2(!error.isEmpty() && !error.contains('\n'), qPrintable(QString::number(size)));
      if (size > 27) QVERIFY2(error.contains("cut off") || error.contains("cannot be read"), qPrintable(error));
    }
    const QByteArray text = test::fbxFixture(1, 1);
    QCOMPARE(errorOf(import(text.left(text.size() / 2), "p.fbx")), QString("is cut off"));
  }

  void damagedBytesOfFbxOnlyComeBack() {
    const QByteArray whole = test::fbxOf(test::BoneForest(4, 2));
    quint32 draw = 1;
    const auto next = [&draw] { return draw = draw * 1664525u + 1013904223u, draw >> 8; };
    for (int round = 0; round < 150; ++round) {
      QByteArray damaged = whole;
      for (int k = 0; k < 3; ++k) damaged[next() % uint(whole.size())] = char(next());
      const QString error = errorOf(import(damaged, "p.fbx"));
      QVERIFY(!error.contains('\n') && error.size() < 400);
    }
  }

  void numbersThatAreNoneAreNamed_data() {
    QTest::addColumn<QString>("replaced");
    QTest::addColumn<QString>("by");
    QTest::newRow("a translation") << "0,100,0\n"
                                   << "0,nan,0\n";
    QTest::newRow("a vertex") << "Vertices: *36 { a: -10"
                              << "Vertices: *36 { a: nan";
    QTest::newRow("a bind matrix") << "0,100,0,1"
                                   << "0,nan,0,1";
    QTest::newRow("a weight") << "Weights: *8 { a: 1"
                              << "Weights: *8 { a: nan";
  }

  void numbersThatAreNoneAreNamed() {
    QFETCH(QString, replaced);
    QFETCH(QString, by);
    QByteArray text = test::fbxFixture(1, 1);
    QVERIFY(text.contains(replaced.toUtf8()));
    text.replace(replaced.toUtf8(), by.toUtf8());
    const auto read = import(text, "p.fbx");
    if (!read) {
      QVERIFY2(!errorOf(read).contains('\n'), qPrintable(errorOf(read)));
      return;
    }
    // Text without a number may also read as 0; then all that comes out is a number.
    for (const Bone& bone : read->bones) QVERIFY(std::isfinite(glm::length(bone.head) + glm::length(bone.tail)));
    for (const Vertex& vertex : read->vertices) QVERIFY(std::isfinite(glm::length(vertex.position)));
    QCOMPARE(QString::fromStdString(sim::problemOf(buildBodies(*read, {}).tree)), QString());
  }

  void bindMatricesAndNodesOfGltfThatAreNoNumbersAreNamed() {
    test::GltfFixture fixture;
    fixture.set("nodes", 3, "translation", QJsonArray{0, 1e39, 0});
    QVERIFY2(!errorOf(import(fixture.glb(), "p.glb")).isEmpty(), "a place beyond all numbers");
    test::GltfFixture binds;
    const auto views = binds.root["bufferViews"].toArray();
    binds.setFloat(views.last().toObject()["byteOffset"].toInt() + 64, std::numeric_limits<float>::quiet_NaN());
    const QString error = errorOf(import(binds.glb(), "p.glb"));
    QVERIFY2(error.contains("bone \"upper\"") && error.contains("bind pose"), qPrintable(error));
  }

  void aMeshWithoutASkeletonIsNamedInFbxToo() {
    QByteArray text = test::fbxFixture(1, 1);
    text.replace("\"OO\",40,10", "\"OO\",40,20");
    QVERIFY2(errorOf(import(text, "p.fbx")).contains("has no armature"), qPrintable(errorOf(import(text, "p.fbx"))));
  }

  void bonesWithoutLengthOrThicknessAreMendedFromTheFile() {
    // The upper joint lies in the lower one: its parent has no length of its own but that of the mesh.
    test::GltfFixture fixture;
    fixture.set("nodes", 3, "translation", QJsonArray{0, 0, 0});
    const auto views = fixture.root["bufferViews"].toArray();
    fixture.setFloat(views.last().toObject()["byteOffset"].toInt() + 64 + 52, 0);
    const auto same = import(fixture.glb(), "p.glb");
    QVERIFY2(same, qPrintable(errorOf(same)));
    QCOMPARE(QString::fromStdString(sim::problemOf(buildBodies(*same, {}).tree)), QString());

    // A tube of no width.
    test::GltfFixture thin;
    const auto place = thin.root["bufferViews"].toArray()[0].toObject()["byteOffset"].toInt();
    for (int i = 0; i < 20; ++i) thin.setFloat(place + 12 * i, 0), thin.setFloat(place + 12 * i + 8, 0);
    const auto read = import(thin.glb(), "p.glb");
    QVERIFY2(read, qPrintable(errorOf(read)));
    QVERIFY2(read->notes.join(';').contains("no thickness"), qPrintable(read->notes.join(';')));
    QCOMPARE(QString::fromStdString(sim::problemOf(buildBodies(*read, {}).tree)), QString());
  }
};

WINDFALL_SUITE(ImportHostileTest)
#include "import_hostile.moc"
