// What averaging took from a texture is given back, and nothing else is.
#include <omp.h>

#include <QtTest>

#include "model/leaf/octave_contrast.h"
#include "model/leaf/working_colours.h"
#include "support/leaf_fixture.h"
#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;

class LeafOctaveContrast : public QObject {
  Q_OBJECT
 private slots:
  void initTestCase() {
    Progress progress;
    Result<LeafStages> leaf = computeStages(test::paintedLeaf({}, 6, 256), Stage::Superpixels, progress);
    QVERIFY(leaf);
    leaf_ = std::move(*leaf);
    lab_ = workingColours(leaf_);
  }

  void theExampleItselfStaysAsItIs() {
    const std::vector<float> same = restoreContrast({leaf_.seen, lab_}, {leaf_.seen, lab_});
    for (size_t i = 0; i < lab_.size(); ++i) QVERIFY(std::abs(same[i] - lab_[i]) < 1e-3f);
  }

  void averagedColoursComeNearerToTheExample() {
    const std::vector<float> blurred = averaged();
    const std::vector<float> restored = restoreContrast({leaf_.seen, blurred}, {leaf_.seen, lab_});
    const double lost = roughness(blurred) / roughness(lab_), kept = roughness(restored) / roughness(lab_);
    QVERIFY2(lost < 0.8 && kept > lost + 0.05 && kept < 1.05, qPrintable(QString("%1 %2").arg(lost).arg(kept)));
    // Lightness alone, and not where there is no leaf.
    for (size_t i = 0; i < lab_.size(); ++i) {
      if (i % 3 != 0 || leaf_.seen.regions.values[i / 3] <= 0) QCOMPARE(restored[i], blurred[i]);
    }
  }

  void whatIsStrongAlreadyIsLeftAlone() {
    std::vector<float> spotted = averaged();
    const size_t width = static_cast<size_t>(leaf_.seen.distance.size.width());
    const size_t middle = 128 * width + width / 2;
    QVERIFY(leaf_.seen.regions.values[middle] > 0);
    spotted[3 * middle] += 60;
    const std::vector<float> restored = restoreContrast({leaf_.seen, spotted}, {leaf_.seen, lab_});
    QVERIFY(std::abs(restored[3 * middle] - spotted[3 * middle]) < 4);
  }

  void threadsDoNotMatter() {
    const std::vector<float> blurred = averaged();
    const int threads = omp_get_max_threads();
    omp_set_num_threads(1);
    const std::vector<float> one = restoreContrast({leaf_.seen, blurred}, {leaf_.seen, lab_});
    omp_set_num_threads(3);
    const std::vector<float> three = restoreContrast({leaf_.seen, blurred}, {leaf_.seen, lab_});
    omp_set_num_threads(threads);
    QCOMPARE(one, three);
  }

 private:
  /// Means of three by three pixels, as overlapping patches give them.
  std::vector<float> averaged() const {
    std::vector<float> result = lab_;
    const int width = leaf_.seen.distance.size.width(), height = leaf_.seen.distance.size.height();
    const auto at = [&](int x, int y) {
      return static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x);
    };
    for (int y = 1; y + 1 < height; ++y) {
      for (int x = 1; x + 1 < width; ++x) {
        for (size_t c = 0; c < 3; ++c) {
          float sum = 0;
          for (int dy = -1; dy <= 1; ++dy) {
            for (int dx = -1; dx <= 1; ++dx) sum += lab_[3 * at(x + dx, y + dy) + c];
          }
          result[3 * at(x, y) + c] = sum / 9;
        }
      }
    }
    return result;
  }

  /// Mean step of the lightness from pixel to pixel on the leaf.
  double roughness(const std::vector<float>& lab) const {
    double sum = 0, count = 0;
    for (size_t i = 1; i < leaf_.seen.regions.values.size(); ++i) {
      if (leaf_.seen.regions.values[i] <= 0 || leaf_.seen.regions.values[i - 1] <= 0) continue;
      sum += std::abs(lab[3 * i] - lab[3 * (i - 1)]), ++count;
    }
    return sum / count;
  }

  LeafStages leaf_;
  std::vector<float> lab_;
};

WINDFALL_SUITE(LeafOctaveContrast)
#include "leaf_octave_contrast.moc"
