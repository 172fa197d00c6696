#include "model/leaf/atlas.h"

#include <QJsonArray>
#include <QJsonDocument>
#include <QTemporaryDir>
#include <QtTest>

#include "model/export/atlas_files.h"
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

std::array<float, 3> labOf(const QColor& colour) {
  QImage one(1, 1, QImage::Format_RGBA8888);
  one.fill(QColor(colour.red(), colour.green(), colour.blue()));
  return meanLab(one);
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

  void anAutomaticSizeIsTheSmallestThatHoldsThemAsWanted() {
    const auto packed = [](int count, int leafPixels, int padding, int mips) {
      AtlasSettings settings{0, padding, mips};
      settings.leafPixels = leafPixels;
      const Result<Atlas> atlas = packAtlas(std::vector<LeafTexture>(static_cast<size_t>(count), texture(1)), settings);
      return atlas ? *atlas : Atlas{};
    };
    const QSize one = texture(1).image.size();
    const auto area = [](const Atlas& atlas) { return atlas.image.width() * atlas.image.height(); };
    for (const int count : {1, 2, 5, 9}) {
      const Atlas atlas = packed(count, 0, 8, 0);
      QCOMPARE(atlas.scale, 1.0);
      for (const int side : {atlas.image.width(), atlas.image.height()}) QCOMPARE(side & (side - 1), 0);
      QVERIFY(area(atlas) >= count * one.width() * one.height());
      for (const QRect& place : atlas.places) QVERIFY(atlas.image.rect().contains(place));
      // The same at half the size needs no more.
      QVERIFY(area(packed(count, std::max(one.width(), one.height()) / 2, 8, 0)) < area(atlas));
    }
    const Atlas small = packed(3, 64, 4, 0);
    for (const QRect& place : small.places) QVERIFY(std::max(place.width(), place.height()) <= 64);
    // Many clean mip levels ask for gaps, and those for room.
    QVERIFY(area(packed(2, 0, 0, 5)) > area(packed(2, 0, 0, 0)));
    // A texture is never enlarged.
    QCOMPARE(packed(1, 4000, 4, 0).scale, 1.0);
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

  void noHaloAtMipFive_data() {
    QTest::addColumn<QColor>("ground");
    QTest::addColumn<int>("shape");
    for (int shape = 0; shape <= int(LeafShape::Maple); ++shape) {
      QTest::addRow("white %d", shape) << QColor(250, 250, 248) << shape;
      QTest::addRow("dark %d", shape) << QColor(12, 12, 16) << shape;
    }
  }
  void noHaloAtMipFive() {
    QFETCH(QColor, ground);
    QFETCH(int, shape);
    // Photographed on this ground: the margin is mixed with it, and all around is nothing but it.
    const PaintedPhoto painted = paintLeafPhoto({LeafShape(shape), 0.2, 0.5}, 4, 500);
    QImage leaf(painted.photo.size(), QImage::Format_RGBA8888);
    for (int y = 0; y < leaf.height(); ++y) {
      for (int x = 0; x < leaf.width(); ++x) {
        const int alpha = painted.mask.constScanLine(y)[x];
        const QColor own = painted.photo.pixelColor(x, y);
        const auto mixed = [&](int a, int b) { return (a * alpha + b * (255 - alpha)) / 255; };
        leaf.setPixelColor(x, y,
                           QColor(mixed(own.red(), ground.red()), mixed(own.green(), ground.green()),
                                  mixed(own.blue(), ground.blue()), alpha));
      }
    }
    LeafTexture upright = uprightTexture("a", leaf, painted.root, painted.tip, 0.08);
    QVERIFY(dressTexture(upright, {}, 1));
    const Result<Atlas> atlas = packAtlas({upright, upright, upright}, {1024, 16});
    QVERIFY(atlas);
    // The leaf's own colours, from well inside.
    std::vector<std::array<float, 3>> inside;
    for (int y = 4; y + 4 < painted.mask.height(); y += 3) {
      for (int x = 4; x + 4 < painted.mask.width(); x += 3) {
        bool deep = true;
        for (int d = -4; d <= 4; ++d) {
          deep = deep && painted.mask.constScanLine(y + d)[x] == 255 && painted.mask.constScanLine(y)[x + d] == 255;
        }
        if (deep) inside.push_back(labOf(painted.photo.pixelColor(x, y)));
      }
    }
    QVERIFY(inside.size() > 500);
    const std::vector<QImage> mips = mipLevels(atlas->image, 5);
    QCOMPARE(mips.size(), size_t(5));
    QCOMPARE(mips[4].size(), QSize(32, 32));
    int visible = 0;
    float worst = 0;
    for (int y = 0; y < 32; ++y) {
      for (int x = 0; x < 32; ++x) {
        if (mips[4].pixelColor(x, y).alpha() == 0) continue;
        const auto lab = labOf(mips[4].pixelColor(x, y));
        float nearest = 1e9f;
        for (const auto& own : inside) {
          nearest = std::min(nearest, std::hypot(lab[0] - own[0], lab[1] - own[1], lab[2] - own[2]));
        }
        worst = std::max(worst, nearest);
        ++visible;
      }
    }
    QVERIFY(visible > 100);
    QVERIFY2(worst <= 20, qPrintable(QString::number(worst)));
  }

  void mipLevelsKeepTheirCoverage() {
    const Result<Atlas> atlas = packAtlas({texture(1), texture(2), texture(3)}, {1024, 16});
    QVERIFY(atlas);
    const auto coverage = [](const QImage& image) {
      int pass = 0;
      for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) pass += image.pixelColor(x, y).alpha() >= 128;
      }
      return double(pass) / (image.width() * image.height());
    };
    const double whole = coverage(atlas->image);
    for (const QImage& mip : mipLevels(atlas->image, 5)) {
      const double texel = 1.0 / (mip.width() * mip.height());
      QVERIFY2(std::abs(coverage(mip) - whole) < 0.01 + 2 * texel, qPrintable(QString::number(coverage(mip))));
    }
  }

  void gapsGrowWithTheMipLevelsWanted() {
    QCOMPARE((AtlasSettings{2048, 16, 1}.gap()), 16);
    QCOMPARE((AtlasSettings{2048, 0, 3}.gap()), 64);
    QCOMPARE((AtlasSettings{2048, 100, 3}.gap()), 100);
    QCOMPARE((AtlasSettings{256, 0, 5}.gap()), 32);
  }

  void mapsLieWhereTheirLeavesLie() {
    LeafTexture t = texture(2);
    QVERIFY(dressTexture(t, {}, 1));
    const Result<Atlas> atlas = packAtlas({t, t}, {1024, 16, 1, false});
    QVERIFY(atlas);
    QCOMPARE(atlas->maps.normal.size(), QSize(1024, 1024));
    for (const QRect& place : atlas->places) {
      const QPoint middle = place.center();
      const QPoint own = middle - place.topLeft();
      QCOMPARE(atlas->maps.roughness.pixel(middle), t.maps.roughness.pixel(own));
      QVERIFY(std::abs(qRed(atlas->maps.normal.pixel(middle)) - qRed(t.maps.normal.pixel(own))) <= 2);
      // Alpha is kept in the normal map.
      QCOMPARE(qAlpha(atlas->maps.normal.pixel(middle)), qAlpha(atlas->image.pixel(middle)));
    }
  }

  void turnedLeavesTurnTheirNormalsAndMeshesWithThem() {
    // Two long leaves on a low shelf: lying is better.
    LeafTexture t = texture(2, 400);
    QVERIFY(dressTexture(t, {}, 1));
    std::vector<LeafTexture> many(5, t);
    AtlasSettings settings{512, 8, 0, true};
    const Result<Atlas> atlas = packAtlas(many, settings);
    settings.rotate = false;
    const Result<Atlas> upright = packAtlas(many, settings);
    QVERIFY(atlas && upright);
    QVERIFY(atlas->scale >= upright->scale);
    for (size_t i = 0; i < 5; ++i) {
      const QPointF pivot = atlas->toAtlas(i, t.pivot);
      const QPoint pixel(int(pivot.x() * 512), int(pivot.y() * 512));
      QVERIFY(atlas->places[i].adjusted(-1, -1, 1, 1).contains(pixel));
      if (!atlas->turned[i]) continue;
      // The tip points right: the petiole's end is at the left.
      QVERIFY(pixel.x() < atlas->places[i].center().x());
    }
  }

  void packersShareChannelsTheirWay() {
    LeafTexture t = texture(2, 200);
    QVERIFY(dressTexture(t, {}, 1));
    const Result<Atlas> atlas = packAtlas({t}, {256, 8, 0, false});
    QVERIFY(atlas);
    const QPoint at = atlas->places[0].center();
    const auto files = [&](AtlasPacker packer) {
      std::map<QString, QImage> images;
      const auto made = atlasFiles(*atlas, {256, 8, 0, false, packer}, "a");
      if (made) {
        for (const NamedBytes& file : *made) {
          if (file.name.endsWith(".png")) images[file.name] = QImage::fromData(file.bytes);
        }
      }
      return images;
    };
    const int rough = qGray(atlas->maps.roughness.pixel(at)), open = qGray(atlas->maps.occlusion.pixel(at));
    auto plain = files(AtlasPacker::Plain);
    QCOMPARE(plain.size(), size_t(6));
    auto gltf = files(AtlasPacker::Gltf);
    const QRgb orm = gltf["a_orm.png"].pixel(at);
    QCOMPARE(qRed(orm), open);
    QCOMPARE(qGreen(orm), rough);
    QCOMPARE(qBlue(orm), 0);
    auto unity = files(AtlasPacker::Unity);
    const QRgb mask = unity["a_mask.png"].pixel(at);
    QCOMPARE(qAlpha(mask), 255 - rough);
    QCOMPARE(qGreen(mask), open);
    auto unreal = files(AtlasPacker::Unreal);
    QCOMPARE(qGreen(unreal["a_normal.png"].pixel(at)), 255 - qGreen(gltf["a_normal.png"].pixel(at)));
    const auto described = atlasFiles(*atlas, {256, 8, 0, false, AtlasPacker::Unity}, "a");
    const QJsonObject json = QJsonDocument::fromJson(described->back().bytes).object();
    QCOMPARE(json["packer"].toString(), "unity");
    QCOMPARE(json["maps"].toObject()["metallicOcclusionDetailSmoothness"].toString(), "a_mask.png");
    const QJsonArray meshes = json["leaves"].toArray()[0].toObject()["meshes"].toArray();
    QCOMPARE(meshes.size(), 4);
    QVERIFY(meshes[0].toObject()["indices"].toArray().size() > 100);
    for (const QJsonValue& uv : meshes[0].toObject()["uvs"].toArray()) {
      QVERIFY(uv.toDouble() >= 0 && uv.toDouble() <= 1);
    }
  }

  void filesAreWrittenAllOrNone() {
    QTemporaryDir folder;
    const QString place = folder.filePath("out");
    QVERIFY(writeTogether(place, {{"a.png", "one"}, {"a_orm.png", "x"}}));
    // One of the new ones cannot be written: none is, and the old ones stay.
    QVERIFY(QDir(place).mkdir("b"));
    const Status status = writeTogether(place, {{"a.png", "two"}, {"b", "three"}});
    QVERIFY(!status);
    QCOMPARE(QString::fromStdString(status.error().message), "b: is a folder");
    QFile kept(place + "/a.png");
    QVERIFY(kept.open(QIODevice::ReadOnly));
    QCOMPARE(kept.readAll(), QByteArray("one"));
    QCOMPARE(QDir(place).entryList(QDir::AllEntries | QDir::NoDotAndDotDot | QDir::Hidden).size(), 3);
    QVERIFY(writeTogether(place, {{"a.png", "two"}}, {"a_orm.png"}));
    QVERIFY(!QFile::exists(place + "/a_orm.png"));
    QFile file(folder.filePath("file"));
    QVERIFY(file.open(QIODevice::WriteOnly));
    QVERIFY(!writeTogether(folder.filePath("file"), {{"a", "b"}}));
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
