// How the score ranks what is made, on painted leaves: quick, so it is small.
#include <QtTest>

#include "support/leaf_fixture.h"
#include "support/quality_order.h"
#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;

class LeafQualityOrder : public QObject {
  Q_OBJECT
 private slots:
  void initTestCase() {
    Progress progress;
    Result<LeafStages> target = computeStages(test::paintedLeaf({}, 6, 384), Stage::Superpixels, progress);
    Result<LeafStages> example =
        computeStages(test::paintedLeaf({LeafShape::Maple, 0.4, 0.4}, 7, 384), Stage::Superpixels, progress);
    QVERIFY(target && example);
    order_ = test::qualityOrder(*target, *example, 2);
    for (const auto& [name, entry] : order_) {
      qInfo("%-32s Q %5.1f  copy %5.2f  diversity %5.1f", name.c_str(), entry.score, entry.copyIndex, entry.diversity);
    }
  }

  void guidedRanksAboveAllElse() {
    for (const auto& [name, entry] : order_) {
      if (name != "guided") QVERIFY2(order_["guided"].score > entry.score + 3, name.c_str());
    }
  }

  void theScoreCannotBeCheated() {
    const double best = order_["guided"].score;
    QVERIFY(order_["naive: one mean colour"].score < 0.2 * best);
    QVERIFY(order_["naive: mean colour of regions"].score < 0.4 * best);
    QVERIFY(order_["naive: random pixels"].score < 0.5 * best);
    QVERIFY(order_["naive: random patches, 32 px"].score < 0.75 * best);
    QVERIFY(order_["mean with veins"].score < 0.5 * best);
    // The stretched photo may look well, but it is told by what it is.
    QVERIFY(order_["naive: photo stretched by rows"].score < 0.9 * best);
    QVERIFY(order_["naive: photo stretched by rows"].copyIndex >= 0.9);
    QVERIFY(order_["guided"].copyIndex < 0.6);
  }

  void whatIsAddedToTheThesisRaisesTheScore() {
    QVERIFY(order_["classic with detail"].score > order_["thesis"].score);
    QVERIFY(order_["thesis"].score > order_["naive: one mean colour"].score);
  }

 private:
  test::QualityOrder order_;
};

WINDFALL_SUITE(LeafQualityOrder)
#include "leaf_quality_order.moc"
