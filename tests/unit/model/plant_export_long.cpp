// Whatever comes in goes out as sound glTF: real trees, plants and presets.
#include <QDir>
#include <QTemporaryDir>
#include <QtTest>

#include "model/export/exporter.h"
#include "model/plant/grow/plant_presets.h"
#include "support/gltf_validator.h"
#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;

class PlantExportLongTest : public QObject {
  Q_OBJECT

  QTemporaryDir empty_;  ///< no presets but our own

  static void validate(Plant plant, int leaves) {
    if (!test::hasValidator()) QSKIP(test::kNoValidator);
    QTemporaryDir folder;
    Project project;
    plant.id = {1};
    project.plants.push_back(std::move(plant));
    project.nextId = 2;
    Progress progress;
    const QString path = folder.filePath("plant.glb");
    const Status written =
        findExporter("gltf")->write(project, {1}, path, {{"leaves", leaves}, {"levels", 2}}, progress);
    QVERIFY2(written, written ? "" : written.error().message.c_str());
    QCOMPARE(test::validatorErrors(path), QString("none"));
  }

 private slots:
  void sharedPlantsAreSound_data() {
    QTest::addColumn<QString>("file");
    QTest::addColumn<int>("leaves");
    bool any = false;
    for (const char* folder : {"trees", "prim"}) {
      const QString path = test::sharedData(folder);
      if (path.isEmpty()) continue;
      for (const QFileInfo& file : QDir(path).entryInfoList({"*.fbx", "*.glb", "*.prim"}, QDir::Files)) {
        for (const int leaves : {0, 1, 2}) {
          QTest::addRow("%s, leaves %d", qPrintable(file.fileName()), leaves) << file.filePath() << leaves;
          any = true;
        }
      }
    }
    if (!any) QTest::newRow("shared/data") << QString() << 0;
  }
  void sharedPlantsAreSound() {
    QFETCH(QString, file);
    QFETCH(int, leaves);
    if (file.isEmpty()) QSKIP("shared/data is not there");
    Plant plant;
    plant.name = QFileInfo(file).fileName();
    plant.file = *readSourceFile(file);
    validate(std::move(plant), leaves);
  }

  void presetsAreSound_data() {
    QTest::addColumn<QString>("name");
    for (const Preset& preset : plantPresets(PresetLibrary(empty_.path())))
      QTest::newRow(qPrintable(preset.name)) << preset.name;
  }
  void presetsAreSound() {
    QFETCH(QString, name);
    Result<Plant> plant = plantOfPreset(PresetLibrary(empty_.path()), name, 1);
    QVERIFY(plant);
    plant->grower->age = std::min(plant->grower->age, 6.0);
    validate(std::move(*plant), 0);
  }
};

WINDFALL_SUITE(PlantExportLongTest)
#include "plant_export_long.moc"
