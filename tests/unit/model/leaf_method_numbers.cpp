// What the method note promises of superpixels, smoothing and patches, with its own numbers (leaf_textures.md, 13).
#include <omp.h>

#include <QtTest>
#include <cmath>
#include <map>

#include "kernels/random.h"
#include "model/leaf/quality.h"
#include "model/leaf/smoothing.h"
#include "model/leaf/stages.h"
#include "model/leaf/superpixels.h"
#include "model/leaf/texture_bench.h"
#include "model/leaf/working_colours.h"
#include "support/leaf_fixture.h"
#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;

namespace {

LeafStages stagesOf(const PaintedLeaf& look, quint64 seed, int size) {
  Progress progress;
  Result<LeafStages> stages = computeStages(test::paintedLeaf(look, seed, size), Stage::Superpixels, progress);
  return stages ? std::move(*stages) : LeafStages{};
}

QImage texture(const LeafStages& target, const LeafStages& example, bool guided, quint64 seed) {
  SynthesisParameters parameters;
  parameters.guided = guided;
  parameters.variety = 0;  // the method alone: no patch of the example has a tone that was added
  Progress progress;
  const Result<QImage> image = synthesize(target, example, parameters, seed, progress);
  return image ? *image : QImage();
}

/// Lab of a whole picture.
std::vector<float> labOf(const QImage& image) {
  LeafStages whole;
  whole.photo = image.convertToFormat(QImage::Format_RGBA8888);
  whole.frame = image.rect();
  whole.mask = QImage(image.size(), QImage::Format_Grayscale8);
  whole.mask.fill(255);
  whole.grown.distance.size = image.size();
  return workingColours(whole);
}

/// Runs `work` with so many threads.
template <class Work>
auto withThreads(int threads, Work work) {
  const int before = omp_get_max_threads();
  omp_set_num_threads(threads);
  auto result = work();
  omp_set_num_threads(before);
  return result;
}

/// Largest difference of both sides of the system inside a disc, of values from 0 to 1.
double residualOf(double w1, int side) {
  const QSize size(side, side);
  std::vector<unsigned char> mask;
  std::vector<float> b;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      mask.push_back(std::hypot(x - side / 2.0, y - side / 2.0) < 0.48 * side);
      // Blocks, as superpixels are.
      for (std::uint32_t c = 0; c < 3; ++c) {
        b.push_back(uniform(3, static_cast<std::uint32_t>(y / 8 * 1000 + x / 8), c));
      }
    }
  }
  std::vector<float> x = b;
  smooth(x, mask, size, w1, sweepsFor(w1));
  double worst = 0;
  for (int y = 1; y + 1 < side; ++y) {
    for (int column = 1; column + 1 < side; ++column) {
      const int i = y * side + column;
      if (!mask[static_cast<size_t>(i)]) continue;
      for (int c = 0; c < 3; ++c) {
        double sum = 0;
        int neighbours = 0;
        for (const int k : {i - 1, i + 1, i - side, i + side}) {
          if (!mask[static_cast<size_t>(k)]) continue;
          sum += static_cast<double>(x[static_cast<size_t>(3 * k + c)]);
          ++neighbours;
        }
        // Of the equation divided by its diagonal, as an update would change it.
        const double solved =
            (static_cast<double>(b[static_cast<size_t>(3 * i + c)]) + w1 * sum) / (1 + w1 * neighbours);
        worst = std::max(worst, std::abs(solved - static_cast<double>(x[static_cast<size_t>(3 * i + c)])));
      }
    }
  }
  return worst;
}

}  // namespace

class LeafMethodNumbers : public QObject {
  Q_OBJECT
 private slots:
  void initTestCase() {
    leaf_ = stagesOf({}, 6, 400);
    QCOMPARE(leaf_.reached, Stage::Superpixels);
  }

  void superpixelsAreAsManyAsWantedAndOfLikeArea_data() {
    QTest::addColumn<int>("count");
    for (const int count : {64, 256, 1024, 2048}) QTest::addRow("%d", count) << count;
  }
  void superpixelsAreAsManyAsWantedAndOfLikeArea() {
    QFETCH(int, count);
    for (const LeafStructure* structure : {&leaf_.grown, &leaf_.seen}) {
      const LabelField labels = makeSuperpixels(structure->distance, structure->regions, count);
      std::map<int, int> areas;
      int leaf = 0;
      for (size_t i = 0; i < labels.values.size(); ++i) {
        QCOMPARE(labels.values[i] > 0, structure->regions.values[i] > 0);
        if (labels.values[i] > 0) ++areas[labels.values[i]], ++leaf;
      }
      // A single one more or less is 1.6 % of 64.
      QVERIFY2(std::abs(labels.count - count) <= std::max(3.0, 0.03 * count),
               qPrintable(QString::number(labels.count)));
      QCOMPARE(static_cast<int>(areas.size()), labels.count);
      const double mean = static_cast<double>(leaf) / labels.count;
      for (const auto& [label, area] : areas) {
        QVERIFY2(area >= 0.2 * mean && area <= 4 * mean,
                 qPrintable(QStringLiteral("%1 of %2 px, mean %3").arg(label).arg(area).arg(mean)));
      }
    }
  }

  void smoothingConvergesHoweverStrong_data() {
    QTest::addColumn<double>("w1");
    // 32 at 1024 px is a weight of 128; 512 is more than any setting gives at 4096 px.
    for (const double w1 : {0.5, 2.0, 8.0, 32.0, 128.0, 512.0}) QTest::addRow("w1 %g", w1) << w1;
  }
  void smoothingConvergesHoweverStrong() {
    QFETCH(double, w1);
    const double residual = residualOf(w1, 160);
    QVERIFY2(residual < 1e-5, qPrintable(QStringLiteral("%1 after %2 sweeps").arg(residual).arg(sweepsFor(w1))));
  }

  void aLeafInItsOwnStructureIsMadeOfItsOwnPatches() {
    LeafStages own = leaf_;
    own.grown = own.seen;
    const ScoredLeaf example{&leaf_.seen, workingColours(leaf_)};
    const QualityReference reference(example);
    const ScoredLeaf made{&own.grown, labOf(texture(own, own, true, 1))};
    const QualityTerms terms = reference.score(made);
    QVERIFY2(terms.coherence <= 1.05, qPrintable(QString::number(terms.coherence)));
    QVERIFY2(terms.score() > 50, qPrintable(QString::number(terms.score())));
  }

  void seedsDiffer() {
    // Spots of age differ from place to place: a leaf of one green has nothing to choose from.
    const LeafStages spotted = stagesOf({LeafShape::Ovate, 0.6, 0.5}, 6, 400);
    const ScoredLeaf four{&spotted.grown, labOf(texture(spotted, spotted, true, 4))};
    const double difference = diversity(four, labOf(texture(spotted, spotted, true, 5)));
    QVERIFY2(difference > 5, qPrintable(QString::number(difference)));
  }

  void threadsChangeNoBit_data() {
    QTest::addColumn<bool>("guided");
    QTest::newRow("guided") << true;
    QTest::newRow("classic") << false;
  }
  void threadsChangeNoBit() {
    QFETCH(bool, guided);
    const QImage one = withThreads(1, [&] { return texture(leaf_, leaf_, guided, 4); });
    QVERIFY(!one.isNull());
    for (const int threads : {2, 4}) {
      QCOMPARE(withThreads(threads, [&] { return texture(leaf_, leaf_, guided, 4); }), one);
    }
  }

  void aPeerThatIsAbsentIsNamed() {
    int told = 0;
    for (const sim::Benchmark& benchmark : textureBenchmarks({{"somebody's SLIC, not found", {}}})) {
      told += benchmark.what.find("skipped: somebody's SLIC, not found") != std::string::npos;
    }
    QCOMPARE(told, 2);
  }

  void threadsChangeNoStage() {
    for (const int threads : {1, 2, 4}) {
      const LeafStages again = withThreads(threads, [] { return stagesOf({}, 6, 400); });
      for (const auto part : {&LeafStages::grown, &LeafStages::seen}) {
        QVERIFY((again.*part).distance.values == (leaf_.*part).distance.values);
        QVERIFY((again.*part).veinDistance.values == (leaf_.*part).veinDistance.values);
        QVERIFY((again.*part).regions.values == (leaf_.*part).regions.values);
        QVERIFY((again.*part).superpixels.values == (leaf_.*part).superpixels.values);
      }
      QVERIFY(again.veins == leaf_.veins);
      QCOMPARE(again.mask, leaf_.mask);
    }
  }

 private:
  LeafStages leaf_;
};

WINDFALL_SUITE(LeafMethodNumbers)
#include "leaf_method_numbers.moc"
