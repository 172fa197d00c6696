// Exporters declare what they need as data and write whole files.
#include "model/export/exporter.h"

#include <QTemporaryDir>
#include <QtTest>

#include "model/export/obj_exporter.h"
#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;

class ExporterTest : public QObject {
  Q_OBJECT
 private slots:
  void theRegistryNamesEachOnce();
  void parametersAreChecked();
  void anAtlasOfNothingIsAnErrorAndNoFile();
  void objHasAllTrianglesFromTheTopOfTheTexture();
  void aGrownPlantIsWrittenWhole();
};

void ExporterTest::theRegistryNamesEachOnce() {
  QStringList ids;
  for (const auto& exporter : exporters()) {
    ids << exporter->id();
    QVERIFY(!exporter->title().isEmpty());
    QVERIFY(!exporter->extensions().isEmpty());
    for (const ExportParameter& parameter : exporter->parameters()) {
      QVERIFY(parameter.low <= parameter.initial && parameter.initial <= parameter.high);
    }
    QCOMPARE(findExporter(exporter->id()), exporter.get());
  }
  QVERIFY(ids.contains("atlas") && ids.contains("obj"));
  QCOMPARE(QSet<QString>(ids.begin(), ids.end()).size(), ids.size());
  QVERIFY(!findExporter("no such"));
}

void ExporterTest::parametersAreChecked() {
  const Exporter& atlas = *findExporter("atlas");
  QCOMPARE(*parameterValue(atlas, {}, "size"), 0.0);
  QCOMPARE(*parameterValue(atlas, {{"size", 512}}, "size"), 512.0);
  for (const QJsonValue& bad : {QJsonValue(-1), QJsonValue(1e9), QJsonValue(100.5), QJsonValue("512")}) {
    const Result<double> value = parameterValue(atlas, {{"size", bad}}, "size");
    QVERIFY(!value);
    QCOMPARE(QString::fromStdString(value.error().message), QString("size: expected a whole number from 0 to 16384"));
  }
  QVERIFY(!parameterValue(atlas, {}, "colour"));
}

void ExporterTest::anAtlasOfNothingIsAnErrorAndNoFile() {
  QTemporaryDir folder;
  Project project;
  Leaf leaf;
  leaf.id = {1};
  leaf.variants = {{1, false, QImage(8, 8, QImage::Format_RGBA8888)}, {2, true, {}}};
  project.leaves = {leaf};
  Progress progress;
  const Exporter& atlas = *findExporter("atlas");
  const Status status = atlas.write(project, {}, folder.filePath("a.png"), {}, progress);
  QVERIFY(!status);
  QCOMPARE(QString::fromStdString(status.error().message), QString("no variant is kept: make some textures first"));
  QVERIFY(!atlas.write(project, {77}, folder.filePath("a.png"), {}, progress));
  QVERIFY(QDir(folder.path()).isEmpty());
}

void ExporterTest::objHasAllTrianglesFromTheTopOfTheTexture() {
  PlantGeometry geometry;
  for (int i = 0; i < 4; ++i) {
    Vertex vertex;
    vertex.position = {float(i), 0.5f, -2};
    vertex.normal = {0, 1, 0};
    vertex.uv = {0.25f, 0.25f};
    geometry.vertices.push_back(vertex);
  }
  geometry.indices = {0, 1, 2, 0, 2, 3};
  geometry.parts = {{0, 3, 0, false}, {3, 3, 1, true}};
  geometry.materials.resize(2);
  geometry.materials[1].name = "Leaf\nKd 9 9 9";
  const QByteArray obj = objText(geometry, "x.mtl");
  QCOMPARE(obj.count("\nv "), 4);
  QCOMPARE(obj.count("\nf "), 2);
  QVERIFY(obj.contains("mtllib x.mtl\n"));
  QVERIFY(obj.contains("vt 0.25 0.75\n"));
  QVERIFY(obj.contains("usemtl material1\nf 1/1/1 3/3/3 4/4/4\n"));
  const QByteArray mtl = mtlText(geometry, {QString(), "x_material1.png"});
  QCOMPARE(mtl.count("newmtl "), 2);
  QVERIFY(mtl.contains("# Leaf Kd 9 9 9\nnewmtl material1\n"));
  QCOMPARE(mtl.count("map_Kd x_material1.png\n"), 1);
}

void ExporterTest::aGrownPlantIsWrittenWhole() {
  QTemporaryDir folder;
  Project project;
  Plant plant;
  plant.id = {1};
  plant.grower = GrowerSettings{};
  plant.grower->limbs = 4;
  project.plants = {plant};
  Progress progress;
  const Exporter& exporter = *findExporter("obj");
  const Status status = exporter.write(project, {1}, folder.filePath("tree.obj"), {}, progress);
  QVERIFY2(status, status ? "" : status.error().message.c_str());
  QFile obj(folder.filePath("tree.obj"));
  QVERIFY(obj.open(QIODevice::ReadOnly));
  const QByteArray text = obj.readAll();
  QVERIFY(text.count("\nf ") > 100);
  QVERIFY(!text.contains("nan") && !text.contains("inf"));
  QVERIFY(QFileInfo::exists(folder.filePath("tree.mtl")));
  QVERIFY(!exporter.write(project, {2}, folder.filePath("none.obj"), {}, progress));
  QVERIFY(!QFileInfo::exists(folder.filePath("none.obj")));
  progress.cancel();
  QVERIFY(!exporter.write(project, {1}, folder.filePath("cancelled.obj"), {}, progress));
  QVERIFY(!QFileInfo::exists(folder.filePath("cancelled.obj")));
}

WINDFALL_SUITE(ExporterTest)
#include "exporter.moc"
