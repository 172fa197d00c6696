#include "model/leaf/atlas.h"

#include <QJsonArray>
#include <QtTest>

#include "model/leaf/dilate.h"
#include "model/sample/leaf_painter.h"
#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;

namespace {

/// A painted leaf cut out by its exact mask; what is outside has the paper's colour until colours are spread.
QImage cutOut(const PaintedPhoto& painted) {
  QImage image = painted.photo.convertToFormat(QImage::Format_RGBA8888);
  for (int y = 0; y < image.height(); ++y) {
    uchar* row = image.scanLine(y);
    for (int x = 0; x < image.width(); ++x) row[4 * x + 3] = painted.mask.constScanLine(y)[x];
  }
  return image;
}

LeafTexture texture(quint64 seed, int size = 300) {
  const PaintedPhoto painted = paintLeafPhoto({}, seed, size);
  return uprightTexture(QStringLiteral("leaf %1").arg(seed), cutOut(painted), painted.root, painted.tip, 0.08);
}

/// Halves an image as a mip level does, colours and alpha apart.
QImage halved(const QImage& image) {
  QImage half(image.width() / 2, image.height() / 2, QImage::Format_RGBA8888);
  for (int y = 0; y < half.height(); ++y) {
    for (int x = 0; x < half.width(); ++x) {
      for (int c = 0; c < 4; ++c) {
        int sum = 2;
        for (const auto& [dx, dy] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 1}}) {
          sum += image.constScanLine(2 * y + dy)[4 * (2 * x + dx) + c];
        }
        half.scanLine(y)[4 * x + c] = static_cast<uchar>(sum / 4);
      }
    }
  }
  return half;
}

}  // namespace

class LeafAtlas : public QObject {
  Q_OBJECT
 private slots:
  void uprightPutsTheTipAboveThePetiolesEnd() {
    const PaintedPhoto painted = paintLeafPhoto({}, 3, 400);
    QTransform turn;
    turn.rotate(115);
    const QImage sideways = cutOut(painted).transformed(turn);
    const QTransform placed = QImage::trueMatrix(turn, painted.photo.width(), painted.photo.height());
    const LeafTexture t = uprightTexture("a", sideways, placed.map(painted.root), placed.map(painted.tip), 0.08);
    QVERIFY(t.image.height() > t.image.width());
    // The pivot is opaque and in the lowest tenth; the tip's column at the top is near the pivot's.
    QVERIFY2(t.pivot.y() > 0.9 && t.pivot.y() <= 1, qPrintable(QString::number(t.pivot.y())));
    const QPoint pivot(int(t.pivot.x() * t.image.width()), int(t.pivot.y() * t.image.height()));
    QVERIFY(qAlpha(t.image.pixel(pivot)) > 16);
    const double blade = 0.08 * t.image.height() / t.metres.height();
    QVERIFY(std::abs(blade - QLineF(painted.root, painted.tip).length()) < 1);
    // Cropped to the leaf but for the margin.
    int top = 0;
    while (top < t.image.height()) {
      bool any = false;
      for (int x = 0; x < t.image.width(); ++x) any = any || qAlpha(t.image.pixel(x, top)) >= 16;
      if (any) break;
      ++top;
    }
    QVERIFY(top <= 3);
  }

  void texturesDoNotOverlapAndKeepTheirDistance() {
    std::vector<LeafTexture> textures;
    for (quint64 seed = 1; seed <= 5; ++seed) textures.push_back(texture(seed));
    const Result<Atlas> atlas = packAtlas(textures, {1024, 16});
    QVERIFY(atlas);
    QCOMPARE(atlas->places.size(), size_t{5});
    for (size_t i = 0; i < atlas->places.size(); ++i) {
      QVERIFY(atlas->image.rect().contains(atlas->places[i]));
      QCOMPARE(atlas->places[i].size(), textures[i].image.size());
      for (size_t k = 0; k < i; ++k) {
        QVERIFY(!atlas->places[i].adjusted(-8, -8, 8, 8).intersects(atlas->places[k].adjusted(-7, -7, 7, 7)));
      }
    }
  }

  void texturesThatDoNotFitAreScaledDownTogether() {
    const std::vector<LeafTexture> textures{texture(1), texture(2), texture(3), texture(4)};
    const Result<Atlas> atlas = packAtlas(textures, {256, 4});
    QVERIFY(atlas);
    const double scale = double(atlas->places[0].height()) / textures[0].image.height();
    QVERIFY(scale < 1);
    for (size_t i = 1; i < 4; ++i) {
      QVERIFY(std::abs(double(atlas->places[i].height()) / textures[i].image.height() - scale) < 0.02);
    }
    QCOMPARE(atlas->textures[2].metres, textures[2].metres);
  }

  void noPaperShowsAtAnyMipLevel() {
    // A leaf of one colour on a ground of another: whatever is visible at mip 5 must be the leaf's colour.
    QImage leaf(200, 300, QImage::Format_RGBA8888);
    for (int y = 0; y < 300; ++y) {
      for (int x = 0; x < 200; ++x) {
        const double r = std::hypot((x - 100) / 80.0, (y - 150) / 130.0);
        const int alpha = std::clamp(int((1 - r) * 40 * 255), 0, 255);
        // As cut out of white paper: the edge is mixed with it.
        const auto mixed = [&](int colour) { return (colour * alpha + 255 * (255 - alpha)) / 255; };
        leaf.setPixelColor(x, y, QColor(mixed(60), mixed(120), mixed(40), alpha));
      }
    }
    const Result<Atlas> atlas = packAtlas({{"a", leaf, {0.5, 1}, {1, 1}}, {"b", leaf, {0.5, 1}, {1, 1}}}, {512, 16});
    QVERIFY(atlas);
    QImage mip = atlas->image;
    for (int level = 0; level <= 5; ++level) {
      for (int y = 0; y < mip.height(); ++y) {
        for (int x = 0; x < mip.width(); ++x) {
          const QColor c = mip.pixelColor(x, y);
          if (c.alpha() > 0) {
            QVERIFY2(std::abs(c.red() - 60) < 6 && std::abs(c.green() - 120) < 6, "paper in the mip levels");
          }
        }
      }
      mip = halved(mip);
    }
  }

  void describesEveryLeaf() {
    const Result<Atlas> atlas = packAtlas({texture(1), texture(2)}, {1024, 8});
    QVERIFY(atlas);
    const QJsonArray leaves = describe(*atlas)["leaves"].toArray();
    QCOMPARE(leaves.size(), 2);
    const QJsonArray rectangle = leaves[1].toObject()["rectangle"].toArray();
    QCOMPARE(rectangle[2].toInt(), atlas->places[1].width());
    const double metres = leaves[1].toObject()["metres"].toArray()[1].toDouble();
    QVERIFY(metres > 0.08 && metres < 0.16);
  }

  void refusesSizesThatCannotBe() {
    QVERIFY(!packAtlas({texture(1)}, {1000, 16}));
    QVERIFY(!packAtlas({texture(1)}, {32, 0}));
    QVERIFY(!packAtlas({texture(1)}, {512, -1}));
    QVERIFY(!packAtlas({}, {512, 16}));
    QVERIFY(!packAtlas({{"none", QImage(), {}, {}}}, {512, 16}));
    // More leaves than pixels.
    QVERIFY(!packAtlas(std::vector<LeafTexture>(3000, texture(1, 64)), {64, 2}));
  }
};

WINDFALL_SUITE(LeafAtlas)
#include "leaf_atlas.moc"
