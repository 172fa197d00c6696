// Several leaves that lend their colours to one texture.
#include <omp.h>

#include <QtTest>

#include "model/leaf/joined_examples.h"
#include "model/leaf/region_match.h"
#include "model/leaf/variant.h"
#include "model/leaf/variant_score.h"
#include "support/leaf_fixture.h"
#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;

namespace {

Leaf numbered(Leaf leaf, quint64 id) {
  leaf.id = {id};
  return leaf;
}

LeafStages stagesOf(const Leaf& leaf) {
  Progress progress;
  Result<LeafStages> stages = computeStages(leaf, Stage::Superpixels, progress);
  return stages ? std::move(*stages) : LeafStages{};
}

/// How much redder than green a region of the target came out, mean over its pixels.
double redness(const LeafStages& target, const QImage& image, int region) {
  double sum = 0, count = 1e-9;
  size_t i = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x, ++i) {
      if (target.grown.regions.values[i] != region) continue;
      const uchar* p = image.constScanLine(y) + 4 * static_cast<size_t>(x);
      sum += p[0] - p[1], count += 1;
    }
  }
  return sum / count;
}

}  // namespace

class LeafExamples : public QObject {
  Q_OBJECT
 private slots:
  void initTestCase() {
    green_ = stagesOf(numbered(test::paintedLeaf({}, 6, 256), 1));
    red_ = stagesOf(numbered(test::paintedLeaf({LeafShape::Maple, 1, 1}, 7, 256), 2));
    QCOMPARE(green_.reached, Stage::Superpixels);
    QCOMPARE(red_.reached, Stage::Superpixels);
    joined_ = joinExamples({green_, red_});
  }

  void regionsOfAllStandSideBySide() {
    QCOMPARE(joined_.joined.size(), size_t(2));
    const LabelField& regions = joined_.seen.regions;
    const auto blades = [](const LabelField& own) { return own.count - (own.petiole > 0); };
    QCOMPARE(blades(regions), blades(green_.seen.regions) + blades(red_.seen.regions));
    QVERIFY(!joined_.joined[0].place.intersects(joined_.joined[1].place));
    // The place of a photo leads to the same region by another number.
    const QPointF place = red_.markers.front();
    const int own = regionAt(red_, red_.seen.regions, place);
    QCOMPARE(exampleRegionAt(joined_, {2}, {1}, place), joined_.joined[1].before + own);
    QCOMPARE(exampleRegionAt(joined_, {}, {1}, green_.markers.front()),
             regionAt(green_, green_.seen.regions, green_.markers.front()));
    QCOMPARE(exampleRegionAt(joined_, {9}, {1}, place), 0);
    // Areas are still shares of the own leaf.
    const std::vector<RegionShape> all = describeRegions(joined_.seen), mine = describeRegions(red_.seen);
    for (int n = 0; n < blades(red_.seen.regions); ++n) {
      const RegionShape& a = all[static_cast<size_t>(joined_.joined[1].before + n)];
      QCOMPARE(a.area, mine[static_cast<size_t>(n)].area);
      QCOMPARE(similarity(a, mine[static_cast<size_t>(n)]), 1.0);
    }
  }

  void eachKeepsItsOwnVeinFrame() {
    const VeinFrame whole = exampleFrame(joined_), own = exampleFrame(red_);
    const QRect& place = joined_.joined[1].place;
    const auto width = static_cast<size_t>(joined_.seen.distance.size.width());
    for (int y = 0; y < place.height(); y += 3) {
      for (int x = 0; x < place.width(); x += 3) {
        const size_t to = static_cast<size_t>(place.y() + y) * width + static_cast<size_t>(place.x() + x);
        const size_t from = static_cast<size_t>(y) * static_cast<size_t>(place.width()) + static_cast<size_t>(x);
        QCOMPARE(whole.angle[to], own.angle[from]);
        QCOMPARE(whole.side[to], own.side[from]);
        QCOMPARE(whole.standing[to], own.standing[from]);
      }
    }
  }

  void regionsOfOneTextureTakeColoursOfSeveralLeaves_data() {
    QTest::addColumn<bool>("guided");
    QTest::newRow("guided") << true;
    QTest::newRow("classic") << false;
  }
  void regionsOfOneTextureTakeColoursOfSeveralLeaves() {
    QFETCH(bool, guided);
    // By hand: every second region from the red leaf, the others from the green one.
    LeafStages target = green_;
    target.made.parameters.synthesis.guided = guided;
    for (size_t i = 0; i < green_.markers.size(); ++i) {
      const LeafStages& from = i % 2 ? red_ : green_;
      target.made.regionPairs.push_back({green_.markers[i], from.made.id, from.markers[i % from.markers.size()]});
    }
    const std::vector<LeafStages> lenders = lendersOf(target, {green_, red_});
    QCOMPARE(lenders.size(), size_t(1));
    Progress progress;
    const Result<Variant> made = makeVariant(target, lenders, 3, progress);
    QVERIFY(made);
    double red = 0, green = 0;
    int reds = 0, greens = 0;
    for (size_t i = 0; i < green_.markers.size(); ++i) {
      const double value = redness(target, made->image, regionAt(target, target.grown.regions, green_.markers[i]));
      (i % 2 ? red : green) += value;
      ++(i % 2 ? reds : greens);
    }
    QVERIFY(reds > 2 && greens > 2);
    QVERIFY2(red / reds > green / greens + 40, qPrintable(QString("%1 %2").arg(red / reds).arg(green / greens)));
    // The same bits for any number of threads.
    const int threads = omp_get_max_threads();
    for (const int n : {1, 2, 4}) {
      omp_set_num_threads(n);
      const Result<Variant> again = makeVariant(target, lenders, 3, progress);
      QVERIFY(again && again->image == made->image);
    }
    omp_set_num_threads(threads);
  }

  void withoutMixingVariantsTakeThemInTurn() {
    LeafStages target = green_;
    target.made.parameters.regions.mix = false;
    const std::vector<LeafStages> lenders = lendersOf(target, {green_, red_});
    QCOMPARE(lenders.size(), size_t(2));
    target.made.parameters.regions.mix = true;
    QCOMPARE(lendersOf(target, {red_}).size(), size_t(1));
    QVERIFY(lendersOf(target, {red_}).front().joined.empty());
  }

  void variantsAreScoredBesideWhatLentThemTheirColours() {
    Leaf leaf = numbered(test::paintedLeaf({}, 6, 256), 1);
    Progress progress;
    const Result<Variant> made = makeVariant(green_, std::span(&red_, 1), 1, progress);
    QVERIFY(made);
    leaf.variants = {*made};
    const Leaf red = numbered(test::paintedLeaf({LeafShape::Maple, 1, 1}, 7, 256), 2);
    const Result<std::vector<VariantScore>> own = scoreVariants(leaf, {}, progress);
    const Result<std::vector<VariantScore>> lent = scoreVariants(leaf, std::span(&red, 1), progress);
    QVERIFY(own && lent);
    QVERIFY2(lent->front().quality > 2 * own->front().quality,
             qPrintable(QString("%1 %2").arg(lent->front().quality).arg(own->front().quality)));
  }

 private:
  LeafStages green_, red_, joined_;
};

WINDFALL_SUITE(LeafExamples)
#include "leaf_examples.moc"
