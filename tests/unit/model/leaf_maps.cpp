// Relief, gloss, light through the blade: what the note says of them, measured.
#include "model/leaf/maps.h"

#include <QElapsedTimer>
#include <QtTest>
#include <cmath>

#include "model/leaf/stages.h"
#include "model/sample/leaf_painter.h"
#include "support/leaf_fixture.h"
#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;

namespace {

/// The leaf cut out of its photo, with the veins that Windfall grows in it.
MapSource sourceOf(const Leaf& leaf) {
  Progress progress;
  const Result<LeafStages> stages = computeStages(leaf, Stage::Distance, progress);
  if (!stages) return {};
  const QSize size = stages->alpha.size();
  MapSource source;
  source.image = stages->photo.copy(stages->frame)
                     .scaled(size, Qt::IgnoreAspectRatio, Qt::SmoothTransformation)
                     .convertToFormat(QImage::Format_RGBA8888);
  source.image.setAlphaChannel(stages->alpha);
  source.image = source.image.convertToFormat(QImage::Format_RGBA8888);
  source.veins = stages->veins;
  for (Vein& vein : source.veins) {
    for (QPointF& p : vein.points) p = stages->toWorking(p);
    vein.startWidth *= stages->scale;
    vein.endWidth *= stages->scale;
  }
  source.root = stages->toWorking(stages->root);
  return source;
}

MapSource painted(int size) { return sourceOf(test::paintedLeaf({}, 3, size)); }

int gray(const QImage& image, QPointF at) { return qGray(image.pixel(qRound(at.x()), qRound(at.y()))); }

/// A place on the first lateral vein, and one between two.
const Vein& lateral(const MapSource& source) {
  for (const Vein& vein : source.veins) {
    if (vein.order == 2 && vein.points.size() > 8) return vein;
  }
  return source.veins.front();
}

}  // namespace

class LeafMapsTest : public QObject {
  Q_OBJECT
 private slots:
  void initTestCase() {
    source_ = painted(512);
    QVERIFY(!source_.image.isNull() && !source_.veins.empty());
    maps_ = makeMaps(source_, {});
  }

  void allHaveTheTexturesSize() {
    for (const QImage* image :
         {&maps_.height, &maps_.normal, &maps_.roughness, &maps_.translucency, &maps_.occlusion, &maps_.ageing}) {
      QCOMPARE(image->size(), source_.image.size());
    }
    QCOMPARE(maps_.normal.convertToFormat(QImage::Format_Alpha8), source_.image.convertToFormat(QImage::Format_Alpha8));
  }

  void slopesAreAsSteepAsTheNotes() {
    // leaf_textures.md, 10: mean tilt 15.7 degrees, 95th percentile 39, on a leaf of 512 px.
    QVERIFY2(std::abs(maps_.meanTilt - 15.7) < 2, qPrintable(QString::number(maps_.meanTilt)));
    QVERIFY2(std::abs(maps_.steepTilt - 39) < 4, qPrintable(QString::number(maps_.steepTilt)));
    MapParameters half;
    half.relief = 0.5;
    const LeafMaps glossy = makeMaps(source_, half);
    QVERIFY(glossy.meanTilt < 0.65 * maps_.meanTilt);
  }

  void slopesOfRealLeavesAreTheSame_data() {
    QTest::addColumn<QString>("photo");
    for (const char* name : {"beech_scan_a.jpg", "soybean_blue.jpg", "ginkgo.jpg"}) QTest::newRow(name) << name;
  }
  void slopesOfRealLeavesAreTheSame() {
    QFETCH(QString, photo);
    Leaf leaf;
    leaf.photo.name = photo;
    QFile file(test::sharedData("photos/" + photo));
    if (!file.open(QIODevice::ReadOnly)) QSKIP("the shared photos are absent");
    leaf.photo.bytes = file.readAll();
    leaf.parameters.synthesis.size = 512;
    const LeafMaps maps = makeMaps(sourceOf(leaf), {});
    QVERIFY2(std::abs(maps.meanTilt - 15.7) < 2, qPrintable(QString::number(maps.meanTilt)));
    QVERIFY2(std::abs(maps.steepTilt - 39) < 4, qPrintable(QString::number(maps.steepTilt)));
  }

  void slopesDoNotDependOnTheSize() {
    const LeafMaps large = makeMaps(painted(1024), {});
    QVERIFY2(std::abs(large.meanTilt - maps_.meanTilt) < 2.5, qPrintable(QString::number(large.meanTilt)));
  }

  void normalsPointUpThePictureByGreenAndOut() {
    // A picture that gets higher towards its top: by a step in its light, taken as relief.
    double blue = 0, count = 0;
    for (int y = 0; y < maps_.normal.height(); ++y) {
      for (int x = 0; x < maps_.normal.width(); ++x) {
        const QRgb p = maps_.normal.pixel(x, y);
        if (qAlpha(p) < 250) continue;
        const double nx = qRed(p) / 127.5 - 1, ny = qGreen(p) / 127.5 - 1, nz = qBlue(p) / 127.5 - 1;
        QVERIFY(std::abs(nx * nx + ny * ny + nz * nz - 1) < 0.03);
        blue += nz;
        count += 1;
      }
    }
    QVERIFY(blue / count > 0.9);
    // Just above a vein that lies across, the surface rises towards the top: the normal leans down, green below half.
    MapSource cross = source_;
    QImage flat(300, 300, QImage::Format_RGBA8888);
    flat.fill(QColor(80, 130, 50));
    cross.image = flat;
    cross.veins = {{1, -1, {{0, 150}, {299, 150}}, 3, 3}};
    cross.root = {0, 150};
    const LeafMaps maps = makeMaps(cross, {});
    double above = 0, below = 0;
    for (int x = 20; x < 280; ++x) {
      above += qGreen(maps.normal.pixel(x, 147));
      below += qGreen(maps.normal.pixel(x, 153));
    }
    QVERIFY2(above < below - 260 * 20, qPrintable(QString("%1 %2").arg(above / 260).arg(below / 260)));
  }

  void veinsAreSunkenRougherAndHoldBackLight() {
    const Vein& vein = lateral(source_);
    const QPointF on = vein.points[vein.points.size() / 2];
    // To the side of it, four pixels at 512 on either hand.
    const QPointF along = vein.points[vein.points.size() / 2 + 1] - on;
    const double length = std::hypot(along.x(), along.y());
    const QPointF aside = on + QPointF(-along.y(), along.x()) * (10 / length);
    QVERIFY(qGray(maps_.height.convertToFormat(QImage::Format_Grayscale8).pixel(on.toPoint())) + 30 <
            qGray(maps_.height.convertToFormat(QImage::Format_Grayscale8).pixel(aside.toPoint())));
    QVERIFY(gray(maps_.roughness, on) > gray(maps_.roughness, aside) + 20);
    QVERIFY(gray(maps_.translucency, on) < gray(maps_.translucency, aside) - 5);
    QVERIFY(gray(maps_.occlusion, on) < gray(maps_.occlusion, aside));
    // Roughness of the blade: 0.55 - 0.15 gloss; dry leaves by 0.3 more.
    QVERIFY(std::abs(gray(maps_.roughness, aside) / 255.0 - (0.55 - 0.15 * 0.3)) < 0.03);
    MapSource dry = source_;
    dry.dryness = 1;
    QVERIFY(std::abs(gray(makeMaps(dry, {}).roughness, aside) - gray(maps_.roughness, aside) - 0.3 * 255) < 3);
  }

  void equalSeedsGiveEqualMaps() {
    const LeafMaps again = makeMaps(source_, {});
    QCOMPARE(again.normal, maps_.normal);
    QCOMPARE(again.ageing, maps_.ageing);
    MapSource other = source_;
    other.seed = 2;
    QVERIFY(makeMaps(other, {}).normal != maps_.normal);
  }

  void aLeafWithoutVeinsHasMapsToo() {
    MapSource bare = source_;
    bare.veins.clear();
    const LeafMaps maps = makeMaps(bare, {});
    QCOMPARE(maps.normal.size(), bare.image.size());
    QVERIFY(maps.meanTilt > 1);
  }

 private:
  MapSource source_;
  LeafMaps maps_;
};

WINDFALL_SUITE(LeafMapsTest)
#include "leaf_maps.moc"
