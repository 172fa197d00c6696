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
  void speciesDiffer();
  void sharedFilesAreImportedOrRefusedInOneLine();
};

void PresetTest::builtInOnesAreThereAndSound() {
  QTemporaryDir folder;
  const PresetLibrary library(folder.path());
  QVERIFY2(library.problems().empty(), library.problems().empty() ? "" : qPrintable(library.problems().front()));
  QStringList names;
  for (const QString domain : {"wind", "leaf", "grower"}) {
    for (const Preset& preset : library.of(domain)) names << domain + "/" + preset.name;
  }
  QCOMPARE(names, (QStringList{"wind/Calm",         "wind/Light breeze",  "wind/Gentle breeze",  "wind/Moderate breeze",
                               "wind/Fresh breeze", "wind/Strong breeze", "wind/Near gale",      "wind/Gale",
                               "wind/Strong gale",  "wind/Storm",         "leaf/Ovate",          "leaf/Oak",
                               "leaf/Birch",        "leaf/Maple",         "leaf/Ginkgo",         "leaf/Beech",
                               "grower/Young tree", "grower/Broad tree",  "grower/Slender tree", "grower/Oak",
                               "grower/Birch",      "grower/Aspen",       "grower/Willow",       "grower/Maple",
                               "grower/Fir",        "grower/Pine",        "grower/Bush",         "grower/Herb",
                               "grower/Dead tree"}));
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
  LeafParameters leaf;
  leaf.veins.seed = 9;
  leaf.synthesis.size = 333;
  leaf.ageing.age = 0.7;
  QVERIFY(applyPreset(*library.find("leaf", "Oak"), leaf));
  QCOMPARE(leaf.veins.laterals, 5);
  QCOMPARE(leaf.veins.seed, quint64(9));
  QCOMPARE(leaf.synthesis.size, 333);
  QCOMPARE(leaf.ageing.age, 0.7);
  QCOMPARE(leaf.ageing.warmth, 0.75);
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

void PresetTest::speciesDiffer() {
  QTemporaryDir folder;
  const PresetLibrary library(folder.path());
  std::vector<LeafParameters> species;
  for (const QString name : {"Oak", "Maple", "Birch", "Ginkgo", "Beech"}) {
    QVERIFY2(library.find("leaf", name), qPrintable(name));
    LeafParameters leaf;
    QVERIFY(applyPreset(*library.find("leaf", name), leaf));
    for (const LeafParameters& other : species) QVERIFY(!(other == leaf));
    species.push_back(leaf);
  }
}

void PresetTest::sharedFilesAreImportedOrRefusedInOneLine() {
  QTemporaryDir folder;
  PresetLibrary library(folder.filePath("own"));
  LeafParameters leaf;
  leaf.epsilon = 3.5;
  leaf.veins.seed = 77;
  leaf.veins.laterals = 3;
  leaf.veins.basalAngle = 40;
  leaf.maps.gloss = 0.9;
  leaf.ageing = {0.8, 4, 0.2, 0.6, 0.9};
  const QString shared = folder.filePath("linden.json");
  QVERIFY(writeDurably(shared, presetToJson(makePreset("Linden", leaf))));
  const Result<Preset> taken = library.import(shared, "leaf");
  QVERIFY(taken);
  QVERIFY(!taken->file.isEmpty());
  LeafParameters read;
  QVERIFY(applyPreset(*PresetLibrary(folder.filePath("own")).find("leaf", "Linden"), read));
  // All but what belongs to one leaf: its seed, and how old it is.
  LeafParameters expected = leaf;
  expected.veins.seed = read.veins.seed;
  expected.ageing.age = 0;
  QVERIFY(read == expected);

  const auto refused = [&](const QByteArray& text, const char* why) {
    const QString path = folder.filePath("bad.json");
    if (!writeDurably(path, text)) return false;
    const Result<Preset> result = library.import(path, "leaf");
    return !result && QString::fromStdString(result.error().message) == QString::fromUtf8(why);
  };
  QVERIFY(refused("hello", "illegal value"));
  QVERIFY(refused(R"({"version": 1, "domain": "wind", "name": "x", "values": {}})",
                  "is a preset of “wind”, not of “leaf”"));
  QVERIFY(refused(R"({"version": 1, "domain": "leaf", "name": "x", "values": {"veins": {"laterals": -4}}})",
                  "values.veins.laterals: is -4, expected 0 to 1000"));
  QVERIFY(refused(R"({"version": 7, "domain": "leaf", "name": "x", "values": {}})", "version: is not 1"));
  QVERIFY(!library.import(folder.filePath("none.json"), "leaf"));
  QCOMPARE(library.of("leaf").size(), size_t(7));
}

WINDFALL_SUITE(PresetTest)
#include "preset.moc"
