// Presets change what they name and nothing else; the artist's own survive, damaged ones are named and left out.
#include "model/presets/preset.h"

#include <QTemporaryDir>
#include <QtTest>

#include "model/document/durable_file.h"
#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;

class PresetTest : public QObject {
  Q_OBJECT
 private slots:
  void builtInOnesAreThereAndSound();
  void applyingChangesOnlyWhatThePresetNames();
  void windsGrowStronger();
  void ownPresetsAreKeptAndGoFirst();
  void nonsenseIsRefusedAndChangesNothing();
  void damagedFilesAreNamedAndLeftOut();
};

void PresetTest::builtInOnesAreThereAndSound() {
  QTemporaryDir folder;
  const PresetLibrary library(folder.path());
  QVERIFY2(library.problems().empty(), library.problems().empty() ? "" : qPrintable(library.problems().front()));
  QStringList names;
  for (const QString domain : {"wind", "leaf", "grower"}) {
    for (const Preset& preset : library.of(domain)) names << domain + "/" + preset.name;
  }
  QCOMPARE(names, (QStringList{"wind/Calm", "wind/Light breeze", "wind/Gentle breeze", "wind/Moderate breeze",
                               "wind/Fresh breeze", "wind/Strong breeze", "wind/Near gale", "wind/Gale",
                               "wind/Strong gale", "wind/Storm", "leaf/Ovate", "leaf/Oak", "leaf/Birch",
                               "grower/Young tree", "grower/Broad tree", "grower/Slender tree"}));
}

void PresetTest::applyingChangesOnlyWhatThePresetNames() {
  QTemporaryDir folder;
  const PresetLibrary library(folder.path());
  sim::WindSettings wind;
  wind.seed = 77;
  wind.direction = {0, 0, 1};
  wind.until = 10;
  QVERIFY(applyPreset(*library.find("wind", "Storm"), wind));
  QCOMPARE(wind.speed, 26.5f);
  QCOMPARE(wind.seed, quint64(77));
  QCOMPARE(wind.until, 10.f);
  QVERIFY((wind.direction == sim::WindSettings{{}, {0, 0, 1}}.direction));
  VeinParameters veins;
  QVERIFY(applyPreset(*library.find("leaf", "Oak"), veins));
  QCOMPARE(veins.laterals, 5);
  GrowerSettings grower;
  QVERIFY(applyPreset(*library.find("grower", "Slender tree"), grower));
  QCOMPARE(grower.height, 12.0);
  QVERIFY(!applyPreset(*library.find("leaf", "Oak"), wind));
}

void PresetTest::windsGrowStronger() {
  QTemporaryDir folder;
  float last = 0;
  for (const Preset& preset : PresetLibrary(folder.path()).of("wind")) {
    sim::WindSettings wind;
    QVERIFY(applyPreset(preset, wind));
    QVERIFY(wind.speed > last);
    last = wind.speed;
  }
}

void PresetTest::ownPresetsAreKeptAndGoFirst() {
  QTemporaryDir folder;
  const QString own = folder.filePath("deep/presets");
  sim::WindSettings wind;
  wind.speed = 7.7f;
  {
    PresetLibrary library(own);
    QVERIFY(library.save(makePreset("Gale", wind)));
    QVERIFY(library.save(makePreset("a/b", wind)));
    wind.speed = 8.8f;
    QVERIFY(library.save(makePreset("a:b", wind)));
    QVERIFY(library.save(makePreset("a/b", wind)));
    QCOMPARE(library.of("wind").size(), size_t(13));
  }
  PresetLibrary library(own);
  QCOMPARE(library.of("wind").size(), size_t(13));
  sim::WindSettings read;
  QVERIFY(applyPreset(*library.find("wind", "Gale"), read));
  QCOMPARE(read.speed, 7.7f);
  QVERIFY(applyPreset(*library.find("wind", "a/b"), read));
  QCOMPARE(read.speed, 8.8f);
  QVERIFY(library.remove("wind", "Gale"));
  QVERIFY(applyPreset(*library.find("wind", "Gale"), read));
  QCOMPARE(read.speed, 19.f);
  QVERIFY(!library.remove("wind", "Gale"));
  QVERIFY(!library.remove("wind", "no such"));
}

void PresetTest::nonsenseIsRefusedAndChangesNothing() {
  sim::WindSettings wind;
  const Status status = applyPreset({"wind", "x", {{"speed", 3}, {"turbulence", "much"}}, {}}, wind);
  QVERIFY(!status);
  QCOMPARE(QString::fromStdString(status.error().message), QString("turbulence: is not a number"));
  QCOMPARE(wind, sim::WindSettings{});
  QTemporaryDir folder;
  PresetLibrary library(folder.path());
  QVERIFY(!library.save({"wind", " ", {}, {}}));
  QVERIFY(!library.save({"weather", "x", {}, {}}));
  QVERIFY(!library.save({"wind", "x", {{"speed", -1}}, {}}));
  QVERIFY(QDir(folder.path()).isEmpty());
}

void PresetTest::damagedFilesAreNamedAndLeftOut() {
  QTemporaryDir folder;
  QVERIFY(writeDurably(folder.filePath("bad.json"),
                       R"({"version": 1, "domain": "wind", "name": "X", "values": {"speed": 999}})"));
  QVERIFY(writeDurably(folder.filePath("text.json"), "hello"));
  const PresetLibrary library(folder.path());
  QCOMPARE(library.problems().size(), size_t(2));
  QCOMPARE(library.problems()[0], folder.filePath("bad.json") + ": values.speed: is 999, expected 0 to 200");
  QCOMPARE(library.of("wind").size(), size_t(10));
}

WINDFALL_SUITE(PresetTest)
#include "preset.moc"
