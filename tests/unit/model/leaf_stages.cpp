// Stages that take over what did not change, rulers, tips, outlines that vary, choices of regions.
#include "model/leaf/stages.h"

#include <QLineF>
#include <QtTest>
#include <algorithm>
#include <set>

#include "model/leaf/field_picture.h"
#include "model/leaf/region_match.h"
#include "model/leaf/shape.h"
#include "model/leaf/variant.h"
#include "support/leaf_fixture.h"
#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;

namespace {

Result<LeafStages> run(const Leaf& leaf, const LeafStages* known = nullptr, Stage last = Stage::Superpixels) {
  Progress progress;
  return computeStages(leaf, last, progress, known);
}

bool same(const LeafStages& a, const LeafStages& b) {
  return a.mask == b.mask && a.border == b.border && a.contour == b.contour && a.root == b.root && a.tip == b.tip &&
         a.veins == b.veins && a.alpha == b.alpha && a.markers == b.markers && a.frame == b.frame &&
         a.grown.distance.values == b.grown.distance.values && a.grown.regions.values == b.grown.regions.values &&
         a.grown.superpixels.values == b.grown.superpixels.values && a.seen.distance.values == b.seen.distance.values &&
         a.seen.regions.values == b.seen.regions.values && a.seen.superpixels.values == b.seen.superpixels.values;
}

}  // namespace

class LeafStagesTest : public QObject {
  Q_OBJECT

  Leaf leaf_ = test::paintedLeaf({}, 4, 260);
  LeafStages stages_;

 private slots:
  void initTestCase() {
    Result<LeafStages> stages = run(leaf_);
    QVERIFY(stages);
    stages_ = std::move(*stages);
    QCOMPARE(stages_.computed.size(), size_t(7));
  }

  void onlyWhatDependsOnAnEditIsComputedAgain_data() {
    QTest::addColumn<QString>("edit");
    QTest::addColumn<QList<int>>("computed");
    const auto list = [](std::initializer_list<Stage> stages) {
      QList<int> result;
      for (const Stage stage : stages) result << static_cast<int>(stage);
      return result;
    };
    QTest::newRow("nothing") << "nothing" << list({});
    QTest::newRow("synthesis") << "smoothing" << list({});
    QTest::newRow("tolerance") << "epsilon" << list({Stage::Contour});
    QTest::newRow("vein seed") << "seed" << list({Stage::Veins, Stage::Distance, Stage::Regions, Stage::Superpixels});
    QTest::newRow("finer veins") << "micro" << list({Stage::Veins});
    QTest::newRow("costs") << "costs" << list({Stage::Distance, Stage::Superpixels});
    QTest::newRow("markers") << "markers" << list({Stage::Regions, Stage::Superpixels});
    QTest::newRow("superpixels") << "superpixels" << list({Stage::Superpixels});
    QTest::newRow("the same mask by hand") << "mask" << list({Stage::Mask});
  }
  void onlyWhatDependsOnAnEditIsComputedAgain() {
    QFETCH(QString, edit);
    QFETCH(QList<int>, computed);
    Leaf leaf = leaf_;
    if (edit == "smoothing") leaf.parameters.synthesis.smoothing = 3;
    if (edit == "epsilon") leaf.parameters.epsilon = 5;
    if (edit == "seed") leaf.parameters.veins.seed = 77;
    if (edit == "micro") leaf.parameters.veins.micro = true;
    if (edit == "costs") leaf.parameters.costs.veinTissue = 6;
    if (edit == "markers") leaf.markers = {stages_.markers[0], stages_.markers[1]};
    if (edit == "superpixels") leaf.parameters.synthesis.superpixels = 150;
    if (edit == "mask") leaf.mask = stages_.mask.copy();
    const Result<LeafStages> again = run(leaf, &stages_);
    QVERIFY(again);
    QList<int> found;
    for (const Stage stage : again->computed) found << static_cast<int>(stage);
    QCOMPARE(found, computed);
    const Result<LeafStages> fresh = run(leaf);
    QVERIFY(fresh);
    QVERIFY(same(*again, *fresh));
  }

  void anotherLeafTakesNothingOver() {
    const Leaf other = test::paintedLeaf({}, 9, 200);
    const Result<LeafStages> stages = run(other, &stages_);
    QVERIFY(stages);
    QCOMPARE(stages->computed.size(), size_t(7));
    QVERIFY(same(*stages, *run(other)));
  }

  void aRulerGivesTheRealSize() {
    Leaf leaf = leaf_;
    leaf.ruler = {QPointF(10, 10), QPointF(10, 110), 0.05};
    const Result<LeafStages> stages = run(leaf, &stages_, Stage::Contour);
    QVERIFY(stages);
    const double pixels = QLineF(stages->root, stages->tip).length();
    QVERIFY(std::abs(stages->bladeLength - pixels * 0.05 / 100) < 1e-12);
    QCOMPARE(stages_.bladeLength, leaf_.bladeLength);
  }

  void tipsByHandWin() {
    Leaf leaf = leaf_;
    leaf.tips = {stages_.border[stages_.border.size() / 3], stages_.border[2 * stages_.border.size() / 3]};
    const Result<LeafStages> stages = run(leaf, &stages_);
    QVERIFY(stages);
    QCOMPARE(stages->tip, leaf.tips[0]);
    QCOMPARE(stages->veins[0].points.back(), leaf.tips[0]);
    QCOMPARE(stages->veins[1].points.back(), leaf.tips[1]);
  }

  void badMarksAreAnErrorOrHarmless() {
    Leaf outside = leaf_;
    outside.root = QPointF(-50, 20);
    const Result<LeafStages> stages = run(outside);
    QVERIFY(!stages);
    QVERIFY(QString::fromStdString(stages.error().message).contains("root"));
    outside.root = QPointF(1, 1);
    const Result<LeafStages> inTheCorner = run(outside);
    QVERIFY(!inTheCorner);
    QCOMPARE(inTheCorner.error().message, std::string("the root lies outside the leaf"));
    outside.root = stages_.root + QPointF(6, 3);
    QVERIFY(run(outside));
    Leaf heap = leaf_;
    heap.markers.assign(40, stages_.markers[0]);
    const Result<LeafStages> heaped = run(heap, &stages_);
    QVERIFY(heaped);
    const LabelField& regions = heaped->grown.regions;
    for (const qint32 region : regions.values) QVERIFY(region <= 1 || region == regions.petiole);
    heap.markers = {{-900, -900}};
    QVERIFY(run(heap, &stages_));
    Progress progress;
    QVERIFY(synthesize(*heaped, *heaped, heap.parameters.synthesis, 1, progress));
  }

  void shapeMapsCanBeUndoneAndKeepRootAndTip() {
    ShapeParameters parameters;
    parameters.vary = true;
    parameters.teeth = 0.1;
    for (quint64 seed = 1; seed < 20; ++seed) {
      const ShapeMap map(parameters, {100, 200}, {120, 20}, seed);
      QVERIFY(QLineF(map.map({100, 200}), {100, 200}).length() < 1e-6);
      QVERIFY(QLineF(map.map({120, 20}), {120, 20}).length() < 1e-6);
      for (const QPointF p : {QPointF(90, 150), QPointF(160, 100), QPointF(60, 60), QPointF(110, 230)}) {
        QVERIFY(QLineF(map.unmap(map.map(p)), p).length() < 0.05);
      }
    }
  }

  void outlinesVaryBySeedWithVeinsOfTheirOwn() {
    Leaf leaf = leaf_;
    leaf.parameters.shape.vary = true;
    leaf.parameters.shape.holes = 3;
    leaf.parameters.shape.bites = 3;
    const Result<LeafStages> stages = run(leaf);
    QVERIFY(stages);
    Progress progress;
    std::vector<LeafStages> others;
    for (const quint64 seed : {1, 2}) {
      Result<LeafStages> varied = computeVariedStages(*stages, seed, progress);
      QVERIFY(varied);
      QCOMPARE(varied->frame, stages->frame);
      QCOMPARE(varied->root, stages->root);
      const double alike = test::overlap(varied->mask, stages->mask);
      QVERIFY2(alike > 0.5 && alike < 0.995, qPrintable(QString::number(alike)));
      QVERIFY(varied->veins != stages->veins);
      QVERIFY(stages->frame.contains(QRect(0, 0, 1, 1).translated(varied->border[0].toPoint())));
      others.push_back(std::move(*varied));
    }
    QVERIFY(others[0].mask != others[1].mask);
    QCOMPARE(computeVariedStages(*stages, 1, progress)->mask, others[0].mask);
    const Result<Variant> variant = makeVariant(*stages, {}, 2, progress);
    QVERIFY(variant);
    QVERIFY(variant->root && variant->tip);
    QCOMPARE(variant->image.size(), stages->alpha.size());
  }

  void outlinesVaryWhereThePhotoHasNoRoomForMore() {
    Leaf tight;
    QImage mask = test::ellipseMask({220, 260}, {4, 6, 212, 220});
    QPainter painter(&mask);
    painter.fillRect(105, 220, 10, 40, Qt::white);  // a petiole that the photo's border cuts
    painter.end();
    tight.photo = {QStringLiteral("mask.png"), test::encoded(mask, "PNG")};
    tight.parameters.shape.vary = true;
    tight.parameters.shape.aspect = 0.3;
    tight.root = QPointF(110, 224);
    const Result<LeafStages> stages = run(tight);
    QVERIFY2(stages, stages ? "" : stages.error().message.c_str());
    Progress progress;
    std::set<int> widths;
    for (const quint64 seed : {1, 2, 3, 4}) {
      const Result<LeafStages> varied = computeVariedStages(*stages, seed, progress);
      QVERIFY(varied);
      const auto [left, right] = std::minmax_element(varied->border.begin(), varied->border.end(),
                                                     [](QPointF a, QPointF b) { return a.x() < b.x(); });
      widths.insert(int(right->x() - left->x()) / 4);
    }
    QVERIFY2(widths.size() > 2, qPrintable(QString::number(widths.size())));
  }

  void aBareMaskTakesColoursOfAnExample() {
    Leaf bare;
    bare.photo = {QStringLiteral("mask.png"), test::encoded(test::ellipseMask({220, 260}, {40, 30, 130, 200}), "PNG")};
    bare.parameters = leaf_.parameters;
    const Result<LeafStages> shape = run(bare);
    QVERIFY2(shape, shape ? "" : shape.error().message.c_str());
    Progress progress;
    const Result<QImage> image = synthesize(*shape, stages_, bare.parameters.synthesis, 3, progress);
    QVERIFY(image);
    const QColor middle = image->pixelColor(image->width() / 2, image->height() / 2);
    QVERIFY(middle.green() > middle.blue());
  }

  void similarityDoesNotChangeWithTheResolutionAndTheThesisOnesDoes() {
    const RegionShape a{0.1f, 0.5f, 0.10, 0.05f, 0.6f, 1000}, b{0.2f, 0.6f, 0.12, 0.1f, 0.7f, 1200},
        c{0.1f, 0.3f, 0.10, 0.1f, 0.3f, 1001};
    QCOMPARE(similarity(a, a), 1.0);
    QCOMPARE(thesisSimilarity(a, a), 1.0);
    const auto larger = [](RegionShape shape) {
      shape.pixels *= 4;
      return shape;
    };
    QCOMPARE(similarity(larger(a), larger(b)), similarity(a, b));
    QVERIFY(std::abs(thesisSimilarity(larger(a), larger(b)) - thesisSimilarity(a, b)) > 1e-9);
    // Area alone decides there: the poorer overlap wins.
    QVERIFY(thesisSimilarity(a, c) > thesisSimilarity(a, b));
    QVERIFY(similarity(a, b) > similarity(a, c));
  }

  void aHeldChoiceIsTheSameForEverySeedAndPairsByHandWin() {
    const auto choice = [](const LeafStages& of, quint64 seed) {
      RandomSequence random(seed, 211);
      return chooseRegions(of, of, random);
    };
    QVERIFY(choice(stages_, 1) != choice(stages_, 2));
    LeafStages held = stages_;
    held.made.parameters.regions.hold = true;
    QCOMPARE(choice(held, 1), choice(held, 2));
    held.made.parameters.regions.seed = 2;
    QCOMPARE(choice(held, 1), choice(stages_, 2));
    // Markers lie in their own regions.
    const QPointF to = stages_.markers[0];
    const int target = regionAt(stages_, stages_.grown.regions, to);
    QPointF from;
    int wanted = 0;
    for (const QPointF& place : stages_.markers) {
      const int region = regionAt(stages_, stages_.seen.regions, place);
      if (region > 0 && region != choice(stages_, 1)[static_cast<size_t>(target - 1)]) from = place, wanted = region;
    }
    QVERIFY(wanted > 0);
    LeafStages paired = stages_;
    paired.made.regionPairs = {{to, {}, from}};
    std::vector<int> expected = choice(stages_, 1);
    expected[static_cast<size_t>(target - 1)] = wanted;
    QCOMPARE(choice(paired, 1), expected);
  }

  void everyFieldHasAPictureAndAScale() {
    for (int i = 0; i <= static_cast<int>(LeafField::Margin); ++i) {
      FieldScale scale;
      const QImage picture = fieldPicture(stages_, static_cast<LeafField>(i), scale);
      QCOMPARE(picture.size(), stages_.photo.size());
      QVERIFY(scale.high > scale.low);
      QVERIFY(scale.ramp.size() >= 2);
      const QPoint on = (0.5 * (stages_.root + stages_.tip)).toPoint();
      QCOMPARE(qAlpha(picture.pixel(on)), 255);
      QCOMPARE(qAlpha(picture.pixel(1, 1)), 0);
    }
    FieldScale scale;
    fieldPicture(stages_, LeafField::Structural, scale);
    QVERIFY(scale.high > 100);
  }
};

WINDFALL_SUITE(LeafStagesTest)
#include "leaf_stages.moc"
