// The ten presets: plants of the sizes that the method note tells, sound, in leaf and bare, and kept in a project.
#include <QTemporaryDir>
#include <QtTest>
#include <algorithm>
#include <cmath>
#include <set>

#include "model/document/project_file.h"
#include "model/plant/bodies.h"
#include "model/plant/grow/grow_plant.h"
#include "model/plant/grow/part_library.h"
#include "model/plant/grow/plant_presets.h"
#include "model/plant/grow/species_bark.h"
#include "model/plant/grow/species_leaf.h"
#include "model/plant/import.h"
#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;
using namespace windfall::model::growth;

namespace {

Plant preset(const char* name, quint64 seed = 1) {
  const QTemporaryDir empty;
  Result<Plant> plant = plantOfPreset(PresetLibrary(empty.path()), QLatin1String(name), seed);
  return plant ? std::move(*plant) : Plant{};
}

Grown skeletonOf(const Plant& plant) {
  Progress progress;
  Result<GrownSkeleton> skeleton = growSkeleton(plant, progress);
  if (!skeleton) qWarning("%s", skeleton.error().message.c_str());
  return skeleton ? std::move(skeleton->grown) : Grown{};
}

}  // namespace

class GrowPresetsTest : public QObject {
  Q_OBJECT
 private slots:
  void sizesAreTheNotes_data();
  void sizesAreTheNotes();
  void swaysLikeATree();
  void bareMeansNoLeaf();
  void leavesAndBarksAreOfTheirSpecies();
  void editsAreFoundAgainAtAnotherAge();
  void everyEditDoesWhatItSays();
  void partsAreKeptAndReadBack();
  void hostilePartsAreRefused();
  void plantsSurviveTheProjectFile();
};

void GrowPresetsTest::sizesAreTheNotes_data() {
  QTest::addColumn<double>("height");
  QTest::addColumn<double>("tolerance");
  QTest::addColumn<int>("nodes");
  QTest::addColumn<int>("order");
  QTest::addRow("Oak") << 15.95 << 0.03 << 7660 << 5;
  QTest::addRow("Birch") << 16.60 << 0.03 << 7465 << 4;
  QTest::addRow("Aspen") << 15.64 << 0.03 << 2202 << 3;
  QTest::addRow("Willow") << 13.28 << 0.12 << 14597 << 4;
  QTest::addRow("Maple") << 13.67 << 0.03 << 4769 << 4;
  QTest::addRow("Fir") << 13.82 << 0.03 << 7913 << 3;
  // More than in the note: shoots of one year do not see each other's shadow here, whatever the order they are made in.
  QTest::addRow("Pine") << 13.45 << 0.05 << 3200 << 7;
  QTest::addRow("Bush") << 1.68 << 0.06 << 4700 << 8;
  QTest::addRow("Herb") << 0.65 << 0.03 << 23 << 1;
  QTest::addRow("Dead tree") << 12.94 << 0.10 << 900 << 4;
}

void GrowPresetsTest::sizesAreTheNotes() {
  QFETCH(double, height);
  QFETCH(double, tolerance);
  QFETCH(int, nodes);
  QFETCH(int, order);
  const Grown grown = skeletonOf(preset(QTest::currentDataTag()));
  QVERIFY(grown.size() > 2);
  double top = 0;
  for (std::size_t i = 1; i < grown.size(); ++i) {
    top = std::max(top, grown.position[i].y);
    const double length = glm::length(grown.position[i] - grown.position[at(grown.parent[i])]);
    QVERIFY2(length > 1e-4 && length < 5, qPrintable(QString::number(length)));
    QVERIFY(grown.parent[i] < static_cast<int>(i) && grown.radius[i] > 0);
    QVERIFY(grown.position[i].y > -0.05);
  }
  const std::vector<int> orders = ordersOf(grown);
  const int highest = *std::max_element(orders.begin(), orders.end());
  qInfo("%s: %.2f m, %d nodes, order %d", QTest::currentDataTag(), top, static_cast<int>(grown.size()), highest);
  QVERIFY(std::abs(top / height - 1) < tolerance);
  QVERIFY(std::abs(static_cast<double>(grown.size()) / nodes - 1) < (nodes < 2500 ? 0.35 : 0.2));
  QVERIFY(std::abs(highest - order) <= 1);
}

void GrowPresetsTest::swaysLikeATree() {
  for (const char* name : {"Birch", "Aspen", "Maple", "Pine"}) {
    const Plant plant = preset(name);
    Progress progress;
    const Result<PlantGeometry> geometry = loadGeometry(plant, progress);
    QVERIFY(geometry);
    const double frequency = sim::firstFrequency(buildBodies(*geometry, plant).tree);
    qInfo("%s: %.2f Hz", name, frequency);
    QVERIFY2(frequency > 0.3 && frequency < 2, qPrintable(QString::number(frequency)));
  }
}

void GrowPresetsTest::bareMeansNoLeaf() {
  Plant plant = preset("Bush");
  Progress progress;
  const Result<PlantGeometry> summer = loadGeometry(plant, progress);
  QVERIFY(summer);
  QVERIFY2(summer->leafSites.size() > 8'000 && summer->leafSites.size() < 25'000,
           qPrintable(QString::number(summer->leafSites.size())));
  plant.grower->foliage.leaves = false;
  const Result<PlantGeometry> winter = loadGeometry(plant, progress);
  QVERIFY(winter && winter->leafSites.empty());
  // Its twigs stay.
  QCOMPARE(winter->indices.size(), summer->indices.size());
  QVERIFY(buildBodies(*winter, plant).tree.sites.empty());
}

void GrowPresetsTest::leavesAndBarksAreOfTheirSpecies() {
  std::set<QByteArray> leaves, barks;
  for (int look = 0; look <= static_cast<int>(LeafLook::Herb); ++look) {
    const LeafTexture texture = speciesLeaf(static_cast<LeafLook>(look), 0, 0.1);
    QVERIFY(!texture.image.isNull());
    qint64 opaque = 0;
    for (int y = 0; y < texture.image.height(); ++y) {
      for (int x = 0; x < texture.image.width(); ++x) opaque += qAlpha(texture.image.pixel(x, y)) > 128;
    }
    const double share = static_cast<double>(opaque) / texture.image.width() / texture.image.height();
    QVERIFY2(share > 0.12 && share < 0.9, qPrintable(QString::number(look) + ": " + QString::number(share)));
    // A blade has its outline, folded at the midrib; needles are a card.
    const bool needles = look == static_cast<int>(LeafLook::Fir) || look == static_cast<int>(LeafLook::Pine);
    QCOMPARE(texture.meshes[0].vertices.empty(), needles);
    if (!needles) {
      QVERIFY(texture.meshes[0].vertices.size() > 20 && texture.meshes[2].vertices.size() <= 8);
      QVERIFY(texture.halfWidth > 0.05f && texture.halfWidth < 1 && texture.stalk > 0 && texture.stalk < 0.5f);
    }
    leaves.insert(QByteArray(reinterpret_cast<const char*>(texture.image.constBits()), texture.image.sizeInBytes()));
  }
  QCOMPARE(leaves.size(), std::size_t{10});
  for (int look = 1; look <= static_cast<int>(BarkLook::Dead); ++look) {
    const QImage bark = speciesBark(static_cast<BarkLook>(look), 1);
    QVERIFY(bark == speciesBark(static_cast<BarkLook>(look), 1));
    barks.insert(QByteArray(reinterpret_cast<const char*>(bark.constBits()), bark.sizeInBytes()));
  }
  QCOMPARE(barks.size(), std::size_t{10});
  // White birch, grey dead wood, red pine.
  const auto mean = [](BarkLook look) {
    return QColor(speciesBark(look, 1).scaled(1, 1, Qt::IgnoreAspectRatio, Qt::SmoothTransformation).pixel(0, 0));
  };
  QVERIFY(mean(BarkLook::Birch).value() > 150 && mean(BarkLook::Oak).value() < 130);
  QVERIFY(mean(BarkLook::Pine).red() > 1.3 * mean(BarkLook::Pine).blue());
  QVERIFY(mean(BarkLook::Dead).saturation() < 40);
}

void GrowPresetsTest::editsAreFoundAgainAtAnotherAge() {
  Plant plant = preset("Aspen");
  plant.grower->age = 30;
  const Grown young = skeletonOf(plant);
  // A stout limb is cut.
  const std::vector<int> orders = ordersOf(young);
  std::size_t limb = 0;
  for (std::size_t i = 1; i < young.size(); ++i) {
    if (orders[i] == 1 && (limb == 0 || young.radius[i] > young.radius[limb])) limb = i;
  }
  HandEdit cut;
  cut.place = QVector3D(static_cast<float>(young.position[limb].x), static_cast<float>(young.position[limb].y),
                        static_cast<float>(young.position[limb].z));
  cut.age = 30;
  plant.handEdits = {cut};
  const Grown pruned = skeletonOf(plant);
  QVERIFY(pruned.size() < young.size());
  // Older, the crown has filled the gap; younger than the cut, it is done all the same.
  for (const double age : {24.0, 40.0, 50.0}) {
    Progress progress;
    plant.grower->age = age;
    const Result<GrownSkeleton> other = growSkeleton(plant, progress);
    QVERIFY(other);
    if (age > 30) QVERIFY(other->lost.empty() && other->grown.size() > pruned.size());
  }
  // The same bits again.
  const Grown again = skeletonOf(plant);
  QVERIFY(again.position == skeletonOf(plant).position);
}

void GrowPresetsTest::everyEditDoesWhatItSays() {
  Plant plant = preset("Dead tree");
  const Grown before = skeletonOf(plant);
  std::size_t node = 0;
  const std::vector<int> orders = ordersOf(before);
  for (std::size_t i = before.size() / 3; i < before.size() && node == 0; ++i) {
    if (orders[i] == 1) node = i;
  }
  QVERIFY(node > 0);
  HandEdit edit;
  edit.age = plant.grower->age;
  const dvec3 p = before.position[node];
  edit.place = QVector3D(static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z));
  const auto with = [&](const std::function<void(HandEdit&)>& change) {
    HandEdit changed = edit;
    change(changed);
    plant.handEdits = {changed};
    return skeletonOf(plant);
  };
  const Grown bent = with([](HandEdit& e) { e.kind = HandEditKind::Bend, e.axis = {0, 0, 1}, e.angle = 30; });
  QCOMPARE(bent.size(), before.size());
  const dvec3 pivot = before.position[at(before.parent[node])];
  QVERIFY(std::abs(glm::length(bent.position[node] - pivot) - glm::length(p - pivot)) < 1e-6);
  QVERIFY(glm::length(bent.position[node] - p) > 0.01);
  const Grown thick = with([](HandEdit& e) { e.kind = HandEditKind::Thicken, e.factor = 1.5; });
  QVERIFY(std::abs(thick.radius[node] / before.radius[node] - 1.5) < 1e-6);
  for (std::size_t i = 1; i < thick.size(); ++i) QVERIFY(thick.radius[i] <= thick.radius[at(thick.parent[i])] + 1e-12);
  const Grown moved = with([](HandEdit& e) { e.kind = HandEditKind::Move, e.offset = {0.2f, 0.1f, 0}; });
  QVERIFY(glm::length(moved.position[node] - p - dvec3(0.2f, 0.1f, 0)) < 1e-6);
  QVERIFY(moved.position[0] == before.position[0]);
  const Grown drawn = with([&](HandEdit& e) {
    e.kind = HandEditKind::Draw, e.line = {e.place + QVector3D(0.5f, 0.2f, 0), e.place + QVector3D(1, 0.6f, 0)};
  });
  QCOMPARE(drawn.size(), before.size() + 2);
  const Grown grafted = with([](HandEdit& e) {
    e.kind = HandEditKind::Graft, e.offset = {1, 0, 0};
    e.part = {{{0, 0, 0}, -1, 0.02}, {{0, 1, 0}, 0, 0.01}, {{0, 1.5f, 0.3f}, 1, 0.005}};
  });
  QCOMPARE(grafted.size(), before.size() + 2);
  QVERIFY(glm::length(grafted.position[before.size()] - p - dvec3(1, 0, 0)) < 1e-5);
  // The whole tree can be felled; a stump stays.
  HandEdit fell;
  fell.age = edit.age;
  fell.place = QVector3D(static_cast<float>(before.position[1].x), static_cast<float>(before.position[1].y),
                         static_cast<float>(before.position[1].z));
  plant.handEdits = {fell};
  QCOMPARE(skeletonOf(plant).size(), std::size_t{2});
  Progress progress;
  QVERIFY(loadGeometry(plant, progress));
}

void GrowPresetsTest::partsAreKeptAndReadBack() {
  const Plant plant = preset("Herb");
  Progress progress;
  const Result<PlantGeometry> geometry = loadGeometry(plant, progress);
  QVERIFY(geometry);
  const PlantPart part = partOf(geometry->bones, 3, QStringLiteral("Top / of: a herb"));
  QVERIFY(part.nodes.size() > 2);
  QVERIFY(part.nodes[1].position.y() > 0 && std::abs(part.nodes[1].position.x()) < 1e-5f);
  QTemporaryDir folder;
  PartLibrary library(folder.path());
  QVERIFY(library.save(part));
  const PartLibrary again(folder.path());
  QCOMPARE(again.parts().size(), std::size_t{1});
  QCOMPARE(again.parts()[0].nodes, part.nodes);
  QVERIFY(library.remove(part.name));
  QVERIFY(PartLibrary(folder.path()).parts().empty());
}

void GrowPresetsTest::hostilePartsAreRefused() {
  for (const char* json : {"", "{", "{\"version\":2}", "{\"version\":1,\"name\":\"a\",\"nodes\":[[0,0,0,1,-1]]}",
                           "{\"version\":1,\"name\":\"a\",\"nodes\":[[0,0,0,1,-1],[0,1,0,1,5]]}",
                           "{\"version\":1,\"name\":\"a\",\"nodes\":[[0,0,0,1,-1],[0,1e9,0,1,0]]}"}) {
    QVERIFY(!partFromJson(json));
  }
}

void GrowPresetsTest::plantsSurviveTheProjectFile() {
  Project project;
  Plant plant = preset("Willow");
  plant.id = {project.nextId++};
  HandEdit edit;
  edit.kind = HandEditKind::Graft;
  edit.part = {{{0, 0, 0}, -1, 0.02}, {{0, 1, 0}, 0, 0.01}};
  plant.handEdits = {edit};
  plant.crown = {QStringLiteral("crown.obj"), "v 0 0 0\n"};
  project.plants = {plant};
  QTemporaryDir folder;
  Progress progress;
  QVERIFY(writeProject(project, folder.filePath("a.windfall"), progress));
  const Result<Project> read = readProject(folder.filePath("a.windfall"), progress);
  QVERIFY(read);
  QVERIFY(read->plants == project.plants);
}

WINDFALL_SUITE(GrowPresetsTest)
#include "grow_presets.moc"
