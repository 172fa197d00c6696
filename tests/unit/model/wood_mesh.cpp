// Plants without triangles of their wood: all else is as with them.
#include <QtTest>

#include "model/plant/geometry_cache.h"
#include "model/plant/grow/plant_presets.h"
#include "model/plant/import.h"
#include "model/plant/skeleton_geometry.h"
#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;

Q_DECLARE_METATYPE(windfall::model::Plant)

class WoodMeshTest : public QObject {
  Q_OBJECT
 private slots:
  void allButTheTrianglesIsTheSame_data() {
    QTest::addColumn<Plant>("plant");
    for (const char* name : {"Birch", "Fir"}) {
      Result<Plant> plant = plantOfPreset(PresetLibrary(), QLatin1String(name), 3);
      QVERIFY(bool(plant));
      QTest::newRow(name) << *plant;
    }
    Plant rule;
    rule.grower = GrowerSettings{};
    QTest::newRow("by rule") << rule;
    for (const char* file : {"prim/herb_101_v5.prim", "trees/tiny_tree.glb"}) {
      const QString path = test::sharedData(QLatin1String(file));
      if (path.isEmpty()) continue;
      QFile data(path);
      QVERIFY(data.open(QIODevice::ReadOnly));
      Plant plant;
      plant.file = SourceFile{QFileInfo(path).fileName(), data.readAll()};
      plant.surface.fromSkeleton = true;
      QTest::newRow(file) << plant;
    }
  }
  void allButTheTrianglesIsTheSame() {
    QFETCH(Plant, plant);
    Progress progress;
    const Result<PlantGeometry> whole = loadGeometry(plant, progress),
                                left = loadGeometry(plant, progress, WoodMesh::Left);
    QVERIFY(bool(whole) && bool(left));
    QVERIFY(whole->wood == WoodMesh::Whole && left->wood == WoodMesh::Left);
    QCOMPARE(left->bones.size(), whole->bones.size());
    for (std::size_t i = 0; i < whole->bones.size(); ++i) {
      QCOMPARE(left->bones[i].name, whole->bones[i].name);
      QVERIFY(left->bones[i].head == whole->bones[i].head && left->bones[i].radius == whole->bones[i].radius);
    }
    QCOMPARE(left->leafSites.size(), whole->leafSites.size());
    QCOMPARE(left->materials.size(), whole->materials.size());
    for (std::size_t i = 0; i < whole->materials.size(); ++i) {
      QCOMPARE(left->materials[i].texture, whole->materials[i].texture);
    }
    QCOMPARE(left->skeleton->rings.rings.size(), whole->skeleton->rings.rings.size());
    // What no skeleton stands for keeps its triangles.
    const auto triangles = [](const PlantGeometry& geometry, bool wood) {
      std::size_t count = 0;
      for (const MeshPart& part : geometry.parts) {
        const bool isWood =
            part.material == 0 || geometry.materials[static_cast<std::size_t>(part.material)].thinner > 0;
        if (isWood == wood) count += part.indexCount / 3;
      }
      return count;
    };
    QVERIFY(triangles(*whole, true) > 100);
    QCOMPARE(triangles(*left, true), std::size_t{0});
    QCOMPARE(triangles(*left, false), triangles(*whole, false));
    QVERIFY(!left->parts.empty());
  }

  void aCacheGivesWholeWoodOnlyWhereItIsKept() {
    Result<Plant> plant = plantOfPreset(PresetLibrary(), QStringLiteral("Bush"), 1);
    QVERIFY(bool(plant));
    GeometryCache cache;
    Progress progress;
    const auto left = cache.load(*plant, progress, WoodMesh::Left);
    const auto again = cache.load(*plant, progress, WoodMesh::Left);
    QVERIFY(left && again && *again == *left);
    const auto whole = cache.load(*plant, progress);
    QVERIFY(whole && (*whole)->wood == WoodMesh::Whole);
    // Once it is there it serves both.
    const auto shared = cache.load(*plant, progress, WoodMesh::Left);
    QVERIFY(shared && *shared == *whole);
  }
};

WINDFALL_SUITE(WoodMeshTest)
#include "wood_mesh.moc"
