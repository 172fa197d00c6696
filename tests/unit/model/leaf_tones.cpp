// Tones of whole leaves: what sets variants apart, and what brings examples together.
#include <omp.h>

#include <QtTest>
#include <numbers>

#include "kernels/random.h"
#include "model/leaf/joined_examples.h"
#include "model/leaf/leaf_tones.h"
#include "model/leaf/quality.h"
#include "model/leaf/small_leaf.h"
#include "model/leaf/tone_variety.h"
#include "model/leaf/working_colours.h"
#include "support/leaf_fixture.h"
#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;

namespace {

constexpr int kSize = 256;

/// A green ellipse with grain; `blotches`: how much broad patches differ, of 255; `cast`: added to red.
Leaf madeUpLeaf(int blotches, float cast = 0) {
  QImage photo(kSize, kSize, QImage::Format_RGB32);
  photo.fill(Qt::white);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const auto cell = [&](int size, std::uint32_t stream) {
        return uniform(7, stream, static_cast<std::uint32_t>(x / size), static_cast<std::uint32_t>(y / size)) - 0.5f;
      };
      const float light = 12 * cell(2, 1) + static_cast<float>(blotches) * cell(28, 2);
      const auto of = [&](float value) { return std::clamp(static_cast<int>(value + light), 0, 255); };
      photo.setPixel(x, y, qRgb(of(70 + cast), of(110), of(45)));
    }
  }
  Leaf leaf;
  leaf.photo = {QStringLiteral("made-up.png"), test::encoded(photo, "PNG")};
  leaf.mask = test::ellipseMask({kSize, kSize}, {70, 16, 116, 224});
  leaf.root = QPointF(128, 238);
  leaf.tips = {{128, 18}};
  leaf.parameters.synthesis.size = kSize;
  leaf.parameters.synthesis.superpixels = 2000;
  return leaf;
}

LeafStages stagesOf(Leaf leaf, quint64 id) {
  leaf.id = {id};
  Progress progress;
  Result<LeafStages> stages = computeStages(leaf, Stage::Superpixels, progress);
  return stages ? std::move(*stages) : LeafStages{};
}

QImage variant(const LeafStages& leaf, bool guided, double variety, quint64 seed) {
  SynthesisParameters parameters = leaf.made.parameters.synthesis;
  parameters.guided = guided;
  parameters.variety = variety;
  Progress progress;
  const Result<QImage> made = synthesize(leaf, leaf, parameters, seed, progress);
  return made ? *made : QImage();
}

/// The colours of a variant, as of a photo that is all leaf.
std::vector<float> labOf(const QImage& image) {
  LeafStages as;
  as.grown.distance.size = image.size();
  as.photo = image;
  as.mask = QImage(image.size(), QImage::Format_Grayscale8);
  as.mask.fill(255);
  as.frame = image.rect();
  return workingColours(as);
}

/// Mean difference of four variants of seeds in a row, each from the one before.
double neighbours(const LeafStages& leaf, bool guided, double variety) {
  std::vector<float> before;
  double sum = 0;
  for (quint64 seed = 1; seed <= 4; ++seed) {
    const ScoredLeaf made{&leaf.grown, labOf(variant(leaf, guided, variety, seed))};
    if (!before.empty()) sum += diversity(made, before) / 3;
    before = made.lab;
  }
  return sum;
}

LeafTones someTones() {
  LeafTones tones;
  tones.direction = {0.8f, 0, 0.6f};
  tones.spread = 2, tones.least = -4, tones.most = 5;
  return tones;
}

}  // namespace

class LeafTonesTest : public QObject {
  Q_OBJECT
 private slots:
  void initTestCase() {
    plain_ = stagesOf(madeUpLeaf(0), 1);
    varied_ = stagesOf(madeUpLeaf(150), 2);
    green_ = stagesOf(test::paintedLeaf({}, 6, kSize), 3);
    red_ = stagesOf(test::paintedLeaf({LeafShape::Maple, 1, 1}, 7, kSize), 4);
    for (const LeafStages* leaf : {&plain_, &varied_, &green_, &red_}) QCOMPARE(leaf->reached, Stage::Superpixels);
  }

  void bothModes_data() {
    QTest::addColumn<bool>("guided");
    QTest::newRow("guided") << true;
    QTest::newRow("classic") << false;
  }

  void theDirectionIsThatOfTheBladesOwnPlaces() {
    std::vector<float> lab = workingColours(plain_);
    const int width = plain_.seen.distance.size.width();
    for (size_t i = 0; i < lab.size() / 3; ++i) {
      const float slope = static_cast<float>(static_cast<int>(i) % width) / static_cast<float>(width) - 0.5f;
      lab[3 * i] = 50 + 24 * slope, lab[3 * i + 1] = -10, lab[3 * i + 2] = 30 - 18 * slope;
    }
    const LeafTones tones = measureTones(plain_, lab);
    QVERIFY(std::abs(tones.mean[0] - 50) < 1 && std::abs(tones.mean[1] + 10) < 0.1 && std::abs(tones.mean[2] - 30) < 1);
    QVERIFY2(tones.direction[0] > 0.77f && tones.direction[2] < -0.57f,
             qPrintable(QString("%1 %2").arg(tones.direction[0]).arg(tones.direction[2])));
    QVERIFY(tones.least < -2 && tones.most > 2 && tones.spread > 1.5f);
  }

  void aBladeOfOneColourKeepsItsHue() {
    std::vector<float> lab = workingColours(plain_);
    for (size_t i = 0; i < lab.size(); ++i) lab[i] = i % 3 == 0 ? 34.f : i % 3 == 1 ? -20.f : 30.f;
    const LeafTones tones = measureTones(plain_, lab);
    QVERIFY(tones.spread < 1e-3f);
    QVERIFY(tones.direction[0] > 0.5f);
    QVERIFY(std::abs(tones.direction[1] / tones.direction[2] + 20.f / 30) < 1e-3f);
  }

  void shiftsEndWhereTheExamplesTonesEnd() {
    const LeafTones tones = someTones();
    for (const float by : {-12.f, -3.f, -0.5f, 0.f, 0.5f, 3.f, 12.f}) {
      const float beyond = 0.2f * std::abs(by);
      float before = -1e9f;
      for (float at = -9; at <= 9; at += 0.25f) {
        const float shift = boundedShift(tones, at, by), moved = at + shift;
        QVERIFY(by == 0 ? shift == 0 : shift * by > 0);
        QVERIFY(std::abs(shift) <= std::abs(by) + 1e-5f);
        if (by > 0) QVERIFY(moved <= std::max(at, tones.most) + beyond + 1e-4f);
        if (by < 0) QVERIFY(moved >= std::min(at, tones.least) - beyond - 1e-4f);
        QVERIFY2(moved >= before, qPrintable(QString("%1 %2").arg(by).arg(at)));
        before = moved;
      }
    }
  }

  void seedsInARowAreSpreadEvenly() {
    constexpr float kCircle = 2 * std::numbers::pi_v<float>;
    for (const quint64 start : {quint64{0}, quint64{1}, quint64{77}, ~quint64{0} - 40}) {
      std::vector<float> angles;
      for (quint64 n = 0; n < 21; ++n) {
        const float angle = toneAngle(start + n);
        QVERIFY(angle >= 0 && angle <= kCircle);
        if (n > 0) {
          const float apart = std::abs(std::remainder(angle - angles.back(), kCircle));
          QVERIFY(apart > 2.35f && apart < 2.45f);
        }
        angles.push_back(angle);
      }
      std::sort(angles.begin(), angles.end());
      float widest = angles.front() + kCircle - angles.back();
      for (size_t i = 1; i < angles.size(); ++i) widest = std::max(widest, angles[i] - angles[i - 1]);
      QVERIFY(widest < 2 * kCircle / 21);
    }
  }

  void halvesAndEndsOfALeafDiffer() {
    const TonePhase phase{{100, 200}, {100, 0}};
    QVERIFY(phase.at(60, 100) * phase.at(140, 100) < 0);
    QVERIFY(std::abs(phase.at(100, 100)) < 1e-5f);
    QVERIFY(phase.at(100, 10) - phase.at(100, 190) > 1.5f);
    // Nowhere a step that would be seen.
    for (int x = 0; x < 200; ++x) QVERIFY(std::abs(phase.at(x + 1, 70) - phase.at(x, 70)) < 0.08f);
  }

  void anEvenExampleGetsTonesAndAVariedOneNone_data() { bothModes_data(); }
  void anEvenExampleGetsTonesAndAVariedOneNone() {
    QFETCH(bool, guided);
    const double alike = neighbours(plain_, guided, 0), toned = neighbours(plain_, guided, 5),
                 strong = neighbours(plain_, guided, 10);
    QVERIFY2(alike < 2.5 && toned > 5 && toned < 6.8 && strong > 10,
             qPrintable(QString("%1 %2 %3").arg(alike).arg(toned).arg(strong)));
    QVERIFY(neighbours(varied_, guided, 0) > 6);
    QCOMPARE(variant(varied_, guided, 5, 2), variant(varied_, guided, 0, 2));
  }

  void heldRegionsLeaveTonesToDiffer() {
    LeafStages held = varied_;
    held.made.parameters.regions.hold = true;
    QVERIFY2(neighbours(held, true, 5) > 5, qPrintable(QString::number(neighbours(held, true, 0))));
  }

  void aToneIsSmoothAndGoesAlongTheExamplesOwn_data() { bothModes_data(); }
  void aToneIsSmoothAndGoesAlongTheExamplesOwn() {
    QFETCH(bool, guided);
    const std::vector<float> without = labOf(variant(plain_, guided, 0, 1)),
                             with = labOf(variant(plain_, guided, 5, 1));
    const LeafTones tones = measureTones(plain_, workingColours(plain_));
    const QSize size = plain_.grown.distance.size;
    const auto width = static_cast<size_t>(size.width());
    double most = 0;
    for (size_t i = width; i < without.size() / 3; ++i) {
      if (plain_.grown.regions.values[i] <= 0 || plain_.grown.regions.values[i - 1] <= 0) continue;
      std::array<float, 3> by{}, beside{};
      float along = 0;
      for (size_t c = 0; c < 3; ++c) {
        by[c] = with[3 * i + c] - without[3 * i + c];
        beside[c] = with[3 * (i - 1) + c] - without[3 * (i - 1) + c];
        along += by[c] * tones.direction[c];
      }
      most = std::max(most, std::abs(static_cast<double>(along)));
      // But for rounding to bytes: no grain, no other hue.
      for (size_t c = 0; c < 3; ++c) {
        QVERIFY(std::abs(by[c] - along * tones.direction[c]) < 1.6f);
        QVERIFY(std::abs(by[c] - beside[c]) < 1.9f);
      }
    }
    QVERIFY2(most > 1.5 && most < 12, qPrintable(QString::number(most)));
  }

  void theSeedAloneDecides_data() { bothModes_data(); }
  void theSeedAloneDecides() {
    QFETCH(bool, guided);
    const int threads = omp_get_max_threads();
    omp_set_num_threads(1);
    const QImage one = variant(plain_, guided, 5, 4);
    for (const int count : {2, 4}) {
      omp_set_num_threads(count);
      const QImage several = variant(plain_, guided, 5, 4);
      omp_set_num_threads(threads);
      QCOMPARE(several, one);
    }
    QVERIFY(!one.isNull());
  }

  void smallLeavesAreTheSameLeaves() {
    const LeafStages small = smallStages(green_, 2);
    QCOMPARE(small.grown.distance.size,
             QSize((green_.grown.distance.size.width() + 1) / 2, (green_.grown.distance.size.height() + 1) / 2));
    const auto area = [](const LabelField& field) {
      return std::count_if(field.values.begin(), field.values.end(), [](qint32 region) { return region > 0; });
    };
    const double share =
        4.0 * static_cast<double>(area(small.grown.regions)) / static_cast<double>(area(green_.grown.regions));
    QVERIFY2(share > 0.95 && share < 1.05, qPrintable(QString::number(share)));
    // No vein is lost between pixels.
    const auto veins = [](const LeafStructure& leaf) {
      qint64 count = 0;
      for (size_t i = 0; i < leaf.regions.values.size(); ++i) {
        count += leaf.regions.values[i] > 0 && leaf.veinDistance.values[i] <= 0;
      }
      return count;
    };
    QVERIFY(4 * veins(small.grown) >= veins(green_.grown));
    QCOMPARE(small.toWorking(small.root) * 2, green_.toWorking(green_.root));
  }

  void castsBetweenExamplesAreTakenAwayAsFarAsIsWanted() {
    const LeafStages tinted = stagesOf(madeUpLeaf(0, 18), 5);
    const float far = apart(plain_, tinted, 0), half = apart(plain_, tinted, 0.5), even = apart(plain_, tinted, 1);
    QVERIFY(far > 5 && far < 10);
    QVERIFY2(std::abs(half - 0.5f * far) < 0.1f * far && even < 0.1f * far,
             qPrintable(QString("%1 %2 %3").arg(far).arg(half).arg(even)));
    // Another season is no cast.
    const float seasons = apart(green_, red_, 0);
    QVERIFY(seasons > 30);
    QVERIFY(std::abs(apart(green_, red_, 1) - seasons) < 0.1f);
  }

 private:
  /// Between the mean colours of two joined leaves.
  static float apart(const LeafStages& one, const LeafStages& other, double even) {
    const LeafStages joined = joinExamples({one, other}, even);
    const std::vector<float> all = workingColours(joined);
    std::array<std::array<float, 3>, 2> mean{};
    for (size_t k = 0; k < 2; ++k) {
      LeafStages part = joined;
      part.joined.clear();
      const QRect& place = joined.joined[k].place;
      LabelField& regions = part.seen.regions;
      for (int y = 0; y < regions.size.height(); ++y) {
        for (int x = 0; x < regions.size.width(); ++x) {
          const size_t i = static_cast<size_t>(y) * static_cast<size_t>(regions.size.width()) + static_cast<size_t>(x);
          if (!place.contains(x, y)) regions.values[i] = 0;
        }
      }
      mean[k] = measureTones(part, all).mean;
    }
    return std::hypot(mean[0][0] - mean[1][0], mean[0][1] - mean[1][1], mean[0][2] - mean[1][2]);
  }

  LeafStages plain_, varied_, green_, red_;
};

WINDFALL_SUITE(LeafTonesTest)
#include "leaf_tones.moc"
