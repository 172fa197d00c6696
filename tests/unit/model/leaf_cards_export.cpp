// Crossed cards of leaf clusters in exports: painted from the leaves, carried by bones, level of detail of the leaves.
#include "model/export/leaf_cards.h"

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QtTest>
#include <cstring>

#include "model/export/gltf_exporter.h"
#include "model/plant/prim_format.h"
#include "support/skeleton_data.h"
#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;

namespace {

/// A square leaf, its left half of `picture` red, nothing in a frame of a quarter.
LeafShape squareShape() {
  LeafShape shape;
  shape.image = QImage(64, 64, QImage::Format_RGBA8888);
  shape.image.fill(Qt::transparent);
  for (int y = 16; y < 48; ++y) {
    for (int x = 16; x < 48; ++x) shape.image.setPixelColor(x, y, x < 32 ? QColor(200, 20, 10) : QColor(20, 160, 30));
  }
  for (const vec2 uv : {vec2(0, 1), vec2(1, 1), vec2(0, 0), vec2(1, 0)}) {
    shape.positions.emplace_back(uv.x - 0.5f, 1 - uv.y, 0);
    shape.normals.emplace_back(0, 0, 1);
    shape.uvs.push_back(uv);
  }
  shape.indices = {0, 1, 2, 2, 1, 3};
  return shape;
}

/// Share of a card's part of the picture that is covered, and its mean colour there.
struct Part {
  double share = 0, red = 0, green = 0;
};

Part partOf(const LeafCards& cards, std::size_t card) {
  vec2 low(1), high(0);
  for (std::size_t i = 4 * card; i < 4 * card + 4; ++i)
    low = glm::min(low, cards.uvs[i]), high = glm::max(high, cards.uvs[i]);
  const QImage& image = cards.image;
  Part part;
  double count = 0;
  const auto px = [](float share, int size) { return static_cast<int>(std::lround(share * static_cast<float>(size))); };
  for (int y = px(low.y, image.height()); y < px(high.y, image.height()); ++y) {
    for (int x = px(low.x, image.width()); x < px(high.x, image.width()); ++x, ++count) {
      const QColor color = image.pixelColor(x, y);
      part.share += color.alphaF();
      part.red += color.red() * color.alphaF();
      part.green += color.green() * color.alphaF();
    }
  }
  part.red /= std::max(part.share, 1e-9);
  part.green /= std::max(part.share, 1e-9);
  part.share /= std::max(count, 1.0);
  return part;
}

}  // namespace

class LeafCardsExportTest : public QObject {
  Q_OBJECT
 private slots:
  void aCardShowsItsLeavesInTheirSizeAndColour();
  void cardsStandInTheirClustersAndLeadOutOfTheCrown();
  void mergedLeavesHaveCardsAsTheirFarLevel();
};

void LeafCardsExportTest::aCardShowsItsLeavesInTheirSizeAndColour() {
  // A leaf that looks along +z: seen whole from there, from its edge from the side and from above.
  PlacedLeaf leaf;
  leaf.position = vec3(2, -0.5f, 3);
  leaf.size = 1;
  const LeafCards cards = paintCards({squareShape()}, {leaf}, {{vec3(2, 0, 3), 1, 0, {0}}});
  QCOMPARE(cards.positions.size(), std::size_t{12});
  const Part front = partOf(cards, 0), side = partOf(cards, 1), top = partOf(cards, 2);
  // Half a metre squared of a card of two metres.
  QVERIFY2(std::abs(front.share - 0.25 / 4) < 0.004, qPrintable(QString::number(front.share)));
  QVERIFY(side.share < 0.01 && top.share < 0.01);
  QVERIFY2(std::abs(front.red - 110) < 12 && std::abs(front.green - 90) < 12,
           qPrintable(QString("%1 %2").arg(front.red).arg(front.green)));
  // Red is at the left, as in the leaf; what is open has the colours beside it.
  QVERIFY(cards.image.pixelColor(28, 32).red() > 150);
  QVERIFY(cards.image.pixelColor(36, 32).green() > 120);
  QVERIFY(cards.image.pixelColor(8, 32).red() > 150 && cards.image.pixelColor(8, 32).alpha() == 0);
}

void LeafCardsExportTest::cardsStandInTheirClustersAndLeadOutOfTheCrown() {
  PlacedLeaf left, right;
  left.position = vec3(-3, 0, 0), right.position = vec3(3, 0, 0);
  left.size = right.size = 0.2f;
  const LeafCards cards =
      paintCards({squareShape()}, {left, right}, {{left.position, 0.5f, 4, {0}}, {right.position, 0.5f, 7, {1}}});
  QCOMPARE(cards.positions.size(), std::size_t{24});
  for (std::size_t i = 0; i < cards.positions.size(); ++i) {
    const bool first = i < 12;
    QCOMPARE(cards.bones[i], first ? 4 : 7);
    QVERIFY(glm::distance(cards.positions[i], first ? left.position : right.position) < 0.72f);
    QVERIFY((cards.normals[i].x < 0) == first);
    QVERIFY(std::abs(glm::length(cards.normals[i]) - 1) < 1e-4f);
  }
  QVERIFY(paintCards({}, {}, {}).indices.empty());
}

void LeafCardsExportTest::mergedLeavesHaveCardsAsTheirFarLevel() {
  Project project;
  Plant plant;
  plant.id = {1};
  plant.name = "Plant";
  plant.file = {"plant.prim", *writePrim(test::smallTree(3), 4)};
  project.plants.push_back(plant);
  project.nextId = 2;
  for (const int bones : {0, 3}) {
    PlantExportOptions options;
    options.leaves = LeafExport::Merged;
    options.levels = 2;
    options.bones.count = bones;
    Progress progress;
    const Result<PlantModel> model = modelOf(project, {1}, options, progress);
    QVERIFY2(model, model ? "" : model.error().message.c_str());
    QVERIFY(!model->leaves.empty());
    QVERIFY(!model->cards.indices.empty());
    for (const int bone : model->cards.bones) {
      QVERIFY(bone >= 0 && bone < static_cast<int>(model->geometry.bones.size()));
    }
    const QByteArray glb = gltfOf(*model, options.leaves);
    std::uint32_t length = 0;
    std::memcpy(&length, glb.constData() + 12, 4);
    const QJsonObject json = QJsonDocument::fromJson(glb.mid(20, static_cast<qsizetype>(length))).object();
    int found = 0;
    for (const QJsonValue node : json["nodes"].toArray()) {
      if (node["name"].toString() != "leaves") continue;
      const int far = node["extensions"]["MSFT_lod"]["ids"][0].toInt(-1);
      QVERIFY(far >= 0);
      const QJsonValue cards = json["nodes"][far];
      QCOMPARE(cards["name"].toString(), QString("leaf cards"));
      QVERIFY(cards.toObject().contains("skin"));
      const QJsonValue primitive = json["meshes"][cards["mesh"].toInt()]["primitives"][0];
      QCOMPARE(json["materials"][primitive["material"].toInt()]["alphaMode"].toString(), QString("MASK"));
      ++found;
    }
    QCOMPARE(found, 1);
    options.levels = 1;
    const Result<PlantModel> plain = modelOf(project, {1}, options, progress);
    QVERIFY(plain && plain->cards.indices.empty());
    QCOMPARE(plain->leaves.size(), model->leaves.size());
  }
}

WINDFALL_SUITE(LeafCardsExportTest)
#include "leaf_cards_export.moc"
