// Regions, their matching, superpixels and smoothing.
#include <QtTest>
#include <cmath>
#include <map>

#include "model/leaf/region_match.h"
#include "model/leaf/regions.h"
#include "model/leaf/smoothing.h"
#include "model/leaf/superpixels.h"
#include "support/leaf_fixture.h"
#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;

namespace {

LeafStages stagesOf(int size) {
  Progress progress;
  Result<LeafStages> stages = computeStages(test::paintedLeaf({}, 4, size), Stage::Superpixels, progress);
  return stages ? std::move(*stages) : LeafStages{};
}

/// b minus the system's left side, largest over the mask.
double residual(const std::vector<float>& x, const std::vector<float>& b, const std::vector<unsigned char>& mask,
                QSize size, double w1) {
  double worst = 0;
  for (int y = 0; y < size.height(); ++y) {
    for (int column = 0; column < size.width(); ++column) {
      const int i = y * size.width() + column;
      if (!mask[static_cast<size_t>(i)]) continue;
      for (int c = 0; c < 3; ++c) {
        double left = x[static_cast<size_t>(3 * i + c)];
        for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
          const int nx = column + dx, ny = y + dy;
          if (nx < 0 || ny < 0 || nx >= size.width() || ny >= size.height()) continue;
          const int k = ny * size.width() + nx;
          if (!mask[static_cast<size_t>(k)]) continue;
          left += w1 * (double(x[static_cast<size_t>(3 * i + c)]) - double(x[static_cast<size_t>(3 * k + c)]));
        }
        worst = std::max(worst, std::abs(b[static_cast<size_t>(3 * i + c)] - left));
      }
    }
  }
  return worst;
}

}  // namespace

class LeafStructureTest : public QObject {
  Q_OBJECT
 private slots:
  void initTestCase() {
    stages_ = stagesOf(300);
    QCOMPARE(stages_.reached, Stage::Superpixels);
  }

  void everyLeafPixelHasARegionAndASuperpixel() {
    for (const LeafStructure* structure : {&stages_.grown, &stages_.seen}) {
      for (const LabelField* labels : {&structure->regions, &structure->superpixels}) {
        QCOMPARE(labels->size, stages_.alpha.size());
        size_t i = 0;
        for (int y = 0; y < labels->size.height(); ++y) {
          for (int x = 0; x < labels->size.width(); ++x, ++i) {
            const bool leaf = stages_.alpha.constScanLine(y)[x] >= 128;
            if (leaf) QVERIFY(labels->values[i] >= 1 && labels->values[i] <= labels->count);
            if (!leaf) QCOMPARE(labels->values[i], 0);
          }
        }
      }
    }
  }

  void givenMarkersAreTheRegions() {
    Leaf leaf = test::paintedLeaf({}, 4, 300);
    const QPointF middle = 0.5 * (stages_.root + stages_.tip);
    leaf.markers = {middle + QPointF(-20, 0), middle + QPointF(20, 0), 0.25 * stages_.root + 0.75 * stages_.tip};
    Progress progress;
    const Result<LeafStages> given = computeStages(leaf, Stage::Regions, progress);
    QVERIFY(given);
    // The petiole comes after them.
    QCOMPARE(given->grown.regions.count, given->grown.regions.petiole > 0 ? 4 : 3);
    const QPointF place = given->toWorking(leaf.markers[1]);
    QCOMPARE(given->grown.regions.values[size_t(int(place.y()) * given->alpha.width() + int(place.x()))], 2);
  }

  void petioleAndBladeLendNothingToEachOther() {
    const LabelField &to = stages_.grown.regions, &from = stages_.seen.regions;
    QVERIFY(to.petiole == to.count && from.petiole == from.count);
    QVERIFY(regionAt(stages_, to, 0.5 * (stages_.petiole.front() + stages_.root)) == to.petiole);
    QVERIFY(regionAt(stages_, to, 0.5 * (stages_.tip + stages_.root)) != to.petiole);
    for (std::uint32_t seed = 1; seed <= 8; ++seed) {
      RandomSequence random(seed);
      const std::vector<int> match = matchRegions(stages_.grown, stages_.seen, random);
      for (size_t i = 0; i < match.size(); ++i) {
        QCOMPARE(match[i] == from.petiole, static_cast<int>(i) + 1 == to.petiole);
      }
    }
  }

  void floodsMeetOnTheVeins() {
    // A vein down the middle of a rectangle; markers off centre, so that halves are not simply what is nearer.
    const QSize size(80, 40);
    std::vector<Tissue> types(80 * 40, Tissue::Blade);
    for (size_t y = 0; y < 40; ++y) types[y * 80 + 40] = Tissue::Vein;
    const LabelField regions = growRegions(types, size, {{4, 20}, {44, 20}});
    for (size_t y = 0; y < 40; ++y) {
      QCOMPARE(regions.values[y * 80 + 37], 1);
      QCOMPARE(regions.values[y * 80 + 43], 2);
    }
  }

  void likeRegionsMatchAtAnyResolution() {
    const RegionShape a{0.2f, 0.5f, 0.05}, b{0.25f, 0.6f, 0.04}, c{0.1f, 0.9f, 0.05};
    QCOMPARE(similarity(a, a), 1.0);
    QVERIFY(similarity(a, b) > similarity(a, c));
    QCOMPARE(similarity(a, b), similarity(b, a));
    const std::vector<RegionShape> small = describeRegions(stages_.grown);
    // Twice the size: every pixel four times.
    LeafStructure large;
    const int width = stages_.alpha.width(), height = stages_.alpha.height();
    large.distance.size = large.regions.size = {2 * width, 2 * height};
    large.regions.count = stages_.grown.regions.count;
    for (int y = 0; y < 2 * height; ++y) {
      for (int x = 0; x < 2 * width; ++x) {
        const auto i = static_cast<size_t>(y / 2 * width + x / 2);
        large.distance.values.push_back(stages_.grown.distance.values[i]);
        large.regions.values.push_back(stages_.grown.regions.values[i]);
      }
    }
    const std::vector<RegionShape> doubled = describeRegions(large);
    QCOMPARE(doubled.size(), small.size());
    for (size_t i = 0; i < small.size(); ++i) QVERIFY(similarity(small[i], doubled[i]) > 0.97);
    RandomSequence one(3), two(3);
    QCOMPARE(matchRegions(stages_.grown, stages_.grown, one).size(), small.size());
    QCOMPARE(matchRegions(large, large, two).size(), small.size());
  }

  void superpixelsAreAsManyAsWantedAndOfLikeArea() {
    const LabelField labels = makeSuperpixels(stages_.grown.distance, stages_.grown.regions, 400);
    QVERIFY2(std::abs(labels.count - 400) <= 12, qPrintable(QString::number(labels.count)));
    std::map<int, int> areas;
    int leaf = 0;
    for (const qint32 label : labels.values) {
      if (label > 0) ++areas[label], ++leaf;
    }
    const double mean = double(leaf) / labels.count;
    for (const auto& [label, area] : areas) QVERIFY2(area < 4 * mean, qPrintable(QString::number(area / mean)));
  }

  void smoothingKeepsConstantsAndTheMean() {
    const QSize size(37, 29);
    std::vector<unsigned char> mask;
    std::vector<float> values, constant;
    for (std::uint32_t i = 0; i < 37 * 29; ++i) {
      const double x = i % 37 - 18.0, y = i / 37 - 14.0;
      mask.push_back(x * x / 300 + y * y / 180 < 1);
      for (std::uint32_t c = 0; c < 3; ++c) {
        values.push_back(uniform(5, i, c));
        constant.push_back(0.3f);
      }
    }
    const std::vector<float> before = values;
    smooth(constant, mask, size, 2, 20);
    for (const float v : constant) QVERIFY(std::abs(v - 0.3f) < 1e-6f);
    smooth(values, mask, size, 2, 20);
    QVERIFY(residual(values, before, mask, size, 2) < 1e-5);
    double sum = 0;
    for (size_t i = 0; i < values.size(); ++i) {
      if (mask[i / 3]) sum += double(values[i]) - double(before[i]);
      if (!mask[i / 3]) QCOMPARE(values[i], before[i]);
    }
    QVERIFY(std::abs(sum) < 1e-3);
  }

  void aCheckerboardIsDampedAsTheSystemSays() {
    const QSize size(64, 64);
    for (const double w1 : {0.5, 2.0, 8.0}) {
      std::vector<float> values;
      for (int i = 0; i < 64 * 64; ++i) values.insert(values.end(), 3, (i % 64 + i / 64) % 2 ? 1.0f : -1.0f);
      smooth(values, std::vector<unsigned char>(64 * 64, 1), size, w1, sweepsFor(w1) + 20);
      QVERIFY(std::abs(std::abs(values[3 * (32 * 64 + 32)]) - 1 / (1 + 8 * w1)) < 1e-3);
    }
  }

 private:
  LeafStages stages_;
};

WINDFALL_SUITE(LeafStructureTest)
#include "leaf_structure.moc"
