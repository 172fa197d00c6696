#include <omp.h>

#include <QtTest>

#include "model/leaf/stages.h"
#include "support/leaf_fixture.h"
#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;

namespace {

QImage variant(const LeafStages& target, const LeafStages& example, bool guided, quint64 seed) {
  SynthesisParameters parameters;
  parameters.guided = guided;
  Progress progress;
  const Result<QImage> image = synthesize(target, example, parameters, seed, progress);
  return image ? *image : QImage();
}

/// Mean of a channel over opaque pixels.
double mean(const QImage& image, int channel) {
  double sum = 0, count = 1e-9;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const uchar* p = image.constScanLine(y) + 4 * x;
      if (p[3] == 255) sum += p[channel], count += 1;
    }
  }
  return sum / count;
}

}  // namespace

class LeafSynthesis : public QObject {
  Q_OBJECT
 private slots:
  void initTestCase() {
    Progress progress;
    Result<LeafStages> green = computeStages(test::paintedLeaf({}, 6, 320), Stage::Superpixels, progress);
    Result<LeafStages> red =
        computeStages(test::paintedLeaf({LeafShape::Maple, 1, 1}, 7, 320), Stage::Superpixels, progress);
    QVERIFY(green && red);
    green_ = std::move(*green);
    red_ = std::move(*red);
  }

  void bothModes_data() {
    QTest::addColumn<bool>("guided");
    QTest::newRow("guided") << true;
    QTest::newRow("classic") << false;
  }

  void theSeedAloneDecides_data() { bothModes_data(); }
  void theSeedAloneDecides() {
    QFETCH(bool, guided);
    const int threads = omp_get_max_threads();
    omp_set_num_threads(1);
    const QImage one = variant(green_, green_, guided, 4);
    QVERIFY(!one.isNull());
    for (const int count : {2, 3, 4}) {
      omp_set_num_threads(count);
      const QImage several = variant(green_, green_, guided, 4);
      omp_set_num_threads(threads);
      QCOMPARE(several, one);
    }
    QVERIFY(variant(green_, green_, guided, 5) != one);
  }

  void theTargetGivesTheShapeAndTheExampleTheColour_data() { bothModes_data(); }
  void theTargetGivesTheShapeAndTheExampleTheColour() {
    QFETCH(bool, guided);
    const QImage own = variant(green_, green_, guided, 1), other = variant(green_, red_, guided, 1);
    QCOMPARE(own.size(), green_.alpha.size());
    QCOMPARE(std::max(own.width(), own.height()), 320);
    for (const QImage& image : {own, other}) {
      for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
          QCOMPARE(image.constScanLine(y)[4 * x + 3], green_.alpha.constScanLine(y)[x]);
        }
      }
    }
    QVERIFY(mean(own, 1) > mean(own, 0));
    QVERIFY(mean(other, 0) > mean(other, 1));
  }

  void theThesisMatchesByStructuralDistanceAlone() {
    SynthesisParameters parameters;
    parameters.guided = false;
    Progress progress;
    const Result<QImage> ours = synthesize(green_, red_, parameters, 3, progress);
    parameters.asThesis = true;
    const Result<QImage> thesis = synthesize(green_, red_, parameters, 3, progress);
    QVERIFY(ours && thesis);
    QVERIFY(*ours != *thesis);
    // The vein distance plays no part in it.
    LeafStages flat = green_;
    for (float& value : flat.grown.veinDistance.values) value = value > 0 ? 0.3f : 0;
    parameters.detail = false;
    const Result<QImage> with = synthesize(green_, red_, parameters, 3, progress),
                         without = synthesize(flat, red_, parameters, 3, progress);
    QVERIFY(with && without);
    QCOMPARE(*with, *without);
  }

  void noGroundShowsUnderTheTransparentPixels() {
    // The paper is far lighter than the leaf; spread colours are the leaf's.
    const QImage image = variant(green_, green_, true, 2);
    const double leaf = mean(image, 2);
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 0; x < image.width(); ++x) {
        const uchar* p = image.constScanLine(y) + 4 * x;
        if (p[3] < 250) QVERIFY(p[2] < leaf + 75);
      }
    }
  }

  void stopsWhenCancelled() {
    Progress progress;
    progress.cancel();
    const Result<QImage> image = synthesize(green_, green_, {}, 1, progress);
    QVERIFY(!image);
    QVERIFY(image.error().cancelled);
    const Result<LeafStages> stages = computeStages(test::paintedLeaf({}, 1, 200), Stage::Superpixels, progress);
    QVERIFY(!stages);
    QVERIFY(stages.error().cancelled);
  }

  void everyStageHasItsPicture() {
    for (const Stage stage :
         {Stage::Mask, Stage::Contour, Stage::Veins, Stage::Distance, Stage::Regions, Stage::Superpixels}) {
      const QImage picture = stagePicture(green_, stage);
      QCOMPARE(picture.size(), green_.photo.size());
      bool drawn = false;
      for (int y = 0; y < picture.height() && !drawn; ++y) {
        for (int x = 0; x < picture.width() && !drawn; ++x) drawn = qAlpha(picture.pixel(x, y)) > 100;
      }
      QVERIFY(drawn);
    }
  }

  void aSmallLeafOnALargeSheetGetsAWholeTexture() {
    const PaintedPhoto painted = paintLeafPhoto({}, 6, 200);
    QImage sheet(800, 600, QImage::Format_RGB32);
    sheet.fill(painted.photo.pixelColor(2, 2));
    QPainter(&sheet).drawImage(420, 300, painted.photo);
    Leaf leaf;
    leaf.photo = {"sheet.png", test::encoded(sheet, "PNG")};
    leaf.mask = QImage(800, 600, QImage::Format_Grayscale8);
    leaf.mask.fill(0);
    QPainter(&leaf.mask).drawImage(420, 300, painted.mask);
    leaf.parameters.synthesis.size = 256;
    Progress progress;
    const Result<LeafStages> stages = computeStages(leaf, Stage::Distance, progress);
    QVERIFY(stages);
    QVERIFY(stages->frame.width() < 200 && stages->frame.left() >= 420);
    QCOMPARE(std::max(stages->alpha.width(), stages->alpha.height()), 256);
    const QPointF root = stages->toVariant(stages->root, stages->alpha.size());
    QVERIFY(stages->alpha.rect().contains(root.toPoint()));
    QCOMPARE(stages->toPhoto(stages->toWorking({500, 400})), QPointF(500, 400));
  }

 private:
  LeafStages green_, red_;
};

WINDFALL_SUITE(LeafSynthesis)
#include "leaf_synthesis.moc"
