#include <QtTest>

#include "model/leaf/quality.h"
#include "model/leaf/quality_baselines.h"
#include "model/leaf/quantiles.h"
#include "model/leaf/region_match.h"
#include "model/leaf/working_colours.h"
#include "support/leaf_fixture.h"
#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;

/// A painted leaf and what the simplest methods make of it: the score must rank them below a photograph.
class LeafQuality : public QObject {
  Q_OBJECT
 private slots:
  void initTestCase() {
    Progress progress;
    Result<LeafStages> stages = computeStages(test::paintedLeaf({}, 6, 512), Stage::Superpixels, progress);
    QVERIFY(stages);
    stages_ = std::move(*stages);
    example_ = {&stages_.seen, workingColours(stages_)};
    reference_ = std::make_unique<QualityReference>(example_);
  }

  void aPictureIsPerfectBesideItself() {
    const QualityTerms terms = reference_->score(example_);
    QCOMPARE(terms.coherence, 1.0);
    QCOMPARE(terms.completeness, 1.0);
    QVERIFY2(std::abs(terms.score() - 100) < 1e-6, qPrintable(QString::number(terms.score())));
  }

  void everyTermSeesWhatItIsMeantToSee() {
    // Each flaw is put into the photo itself, so that only its own term may fall far.
    ScoredLeaf tinted = example_;
    for (size_t i = 1; i < tinted.lab.size(); i += 3) tinted.lab[i] += 15;
    const QualityTerms tint = reference_->score(tinted);
    QVERIFY(tint.colour < std::exp(-1.4) && tint.texture > 0.99 && tint.veins > 0.99);
    QVERIFY(std::abs(tint.difference - 15) < 0.1);

    ScoredLeaf blurred = example_;
    blurred.lab = blur(example_, 3);
    const QualityTerms soft = reference_->score(blurred);
    QVERIFY(soft.colour > 0.7 && soft.texture < 0.6);

    ScoredLeaf one = example_;
    for (size_t i = 3; i < one.lab.size(); ++i) one.lab[i] = one.lab[i - 3];
    const QualityTerms flat = reference_->score(one);
    QCOMPARE(flat.veins, 0.02);
    QVERIFY(flat.texture < 0.01);
    QVERIFY(flat.completeness > 2);
  }

  void theScoreFollowsTheFormula() {
    QualityTerms terms;
    terms.colour = 0.5, terms.texture = 0.4, terms.patches = 0.8, terms.veins = 0.1;
    QVERIFY(std::abs(terms.score() - 100 * std::pow(0.016, 0.25)) < 1e-9);
    QCOMPARE(wasserstein(quantiles({1, 2, 3}, 64), quantiles({4, 5, 6}, 64)), 3.0);
    QCOMPARE(wasserstein(quantiles({1, 9}, 64), quantiles({9, 1}, 64)), 0.0);
  }

  void naiveColouringsRankBelowAndTheStretchedPhotoIsACopy() {
    RandomSequence random(1, 211);
    const std::vector<int> match = matchRegions(stages_.grown, stages_.seen, random);
    std::map<std::string, double> q;
    const std::vector<float> stretched =
        stretchRows(stages_.grown, workingAxis(stages_), example_, workingAxis(stages_));
    for (const Baseline& baseline : naiveBaselines()) {
      const ScoredLeaf made{&stages_.grown, baseline.colour({stages_, stages_, example_.lab, match, 1})};
      q[baseline.name] = reference_->score(made).score();
      const double copy = copyIndex(made, stretched);
      QVERIFY2(baseline.name.find("stretched") != std::string::npos ? copy > 0.9 : copy < 0.9, baseline.name.c_str());
    }
    QVERIFY(q["naive: one mean colour"] < 5);
    QVERIFY(q["naive: mean colour of regions"] < 15 &&
            q["naive: mean colour of regions"] > q["naive: one mean colour"]);
    QVERIFY(q["naive: random pixels"] < 20);
    QVERIFY(q["naive: random patches, 32 px"] < 35);
  }

  void diversityIsTheMeanDifferenceOfColour() {
    std::vector<float> lighter = example_.lab;
    for (size_t i = 0; i < lighter.size(); i += 3) lighter[i] += 3, lighter[i + 2] += 4;
    QVERIFY(std::abs(diversity(example_, lighter) - 5) < 1e-3);
    QCOMPARE(diversity(example_, example_.lab), 0.0);
    QVERIFY(std::abs(copyIndex(example_, lighter) - 1) < 1e-6);
  }

  void plainLeavesHaveALowCeilingOfDiversity() {
    // Two colours in equal halves: two draws differ in half the cases, by the distance of the colours.
    ScoredLeaf halves = example_;
    const int width = stages_.seen.distance.size.width();
    double left = 0, all = 0;
    for (size_t i = 0; i < halves.lab.size() / 3; ++i) {
      const bool first = static_cast<int>(i) % width < width / 2;
      halves.lab[3 * i] = first ? 40 : 60, halves.lab[3 * i + 1] = 0, halves.lab[3 * i + 2] = 0;
      if (stages_.seen.regions.values[i] > 0) left += first, ++all;
    }
    const double wanted = 20 * 2 * (left / all) * (1 - left / all);
    QVERIFY2(std::abs(diversityCeiling(halves) - wanted) < 1, qPrintable(QString::number(diversityCeiling(halves))));
    for (float& value : halves.lab) value = 30;
    QVERIFY(diversityCeiling(halves) < 1e-3);
  }

  void theScoreDoesNotDependOnTheResolution() {
    // The same leaf at 256 px, scored by itself with lengths that follow.
    Progress progress;
    const Result<LeafStages> small = computeStages(test::paintedLeaf({}, 6, 256), Stage::Superpixels, progress);
    QVERIFY(small);
    const ScoredLeaf example{&small->seen, workingColours(*small)};
    QVERIFY(std::abs(QualityReference(example).score(example).score() - 100) < 1e-6);
  }

 private:
  /// Means over (2 reach + 1)^2 pixels of the leaf.
  static std::vector<float> blur(const ScoredLeaf& leaf, int reach) {
    const int width = leaf.structure->distance.size.width(), height = leaf.structure->distance.size.height();
    std::vector<float> soft = leaf.lab;
    for (int y = reach; y < height - reach; ++y) {
      for (int x = reach; x < width - reach; ++x) {
        float sum[3] = {0, 0, 0}, count = 0;
        for (int j = y - reach; j <= y + reach; ++j) {
          for (int i = x - reach; i <= x + reach; ++i) {
            const auto k = static_cast<size_t>(j * width + i);
            if (leaf.structure->regions.values[k] <= 0) continue;
            for (size_t c = 0; c < 3; ++c) sum[c] += leaf.lab[3 * k + c];
            ++count;
          }
        }
        for (size_t c = 0; c < 3 && count > 0; ++c) soft[3 * static_cast<size_t>(y * width + x) + c] = sum[c] / count;
      }
    }
    return soft;
  }

  LeafStages stages_;
  ScoredLeaf example_;
  std::unique_ptr<QualityReference> reference_;
};

WINDFALL_SUITE(LeafQuality)
#include "leaf_quality.moc"
