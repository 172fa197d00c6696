// Leaves turn: many of them by a chain of states, one of them from green to brown with its veins last.
#include "model/leaf/ageing.h"

#include <QtTest>
#include <cmath>

#include "model/leaf/maps.h"
#include "model/sample/leaf_painter.h"
#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;

namespace {

/// A green blade with a main vein down its middle and laterals, and its ageing map.
struct Green {
  QImage image{200, 300, QImage::Format_RGBA8888};
  LeafMaps maps;
  Green() {
    image.fill(Qt::transparent);
    MapSource source;
    for (int y = 10; y < 290; ++y) {
      for (int x = 0; x < 200; ++x) {
        if (std::hypot((x - 100) / 85.0, (y - 150) / 140.0) < 1) image.setPixelColor(x, y, QColor(70, 120 + x % 7, 45));
      }
    }
    source.image = image;
    source.veins = {{1, -1, {{100, 289}, {100, 12}}, 3, 2}};
    source.root = {100, 289};
    maps = makeMaps(source, {});
  }
};

/// How green a colour is: negative a*, roughly.
double greenness(QRgb p) { return qGreen(p) - 0.5 * (qRed(p) + qBlue(p)); }

}  // namespace

class LeafAgeingTest : public QObject {
  Q_OBJECT
 private slots:
  void rowsOfTheChainSumToOne() {
    for (const double temperature : {-5.0, 0.0, 6.0, 12.0, 25.0}) {
      for (const double wetness : {0.0, 1.0}) {
        AgeingParameters p;
        p.temperature = temperature;
        p.wetness = wetness;
        for (const SeasonStates& row : dailyChange(p)) {
          double sum = 0;
          for (const double v : row) {
            QVERIFY(v >= 0);
            sum += v;
          }
          QVERIFY(std::abs(sum - 1) < 1e-12);
        }
      }
    }
    // At 12 degrees, wetness and redness of the note's species: its table.
    const auto chain = dailyChange({});
    QVERIFY(std::abs(chain[0][0] - 0.93) < 1e-12 && std::abs(chain[1][3] - 0.06) < 1e-12 && chain[3][3] == 1);
  }

  void coldAndDrynessHurry() {
    AgeingParameters cold, dry;
    cold.temperature = 6;
    dry.wetness = 0;
    // Six degrees less double each chance: of the green ones 0.86 stay.
    QVERIFY(std::abs(dailyChange(cold)[0][0] - 0.86) < 1e-12);
    QVERIFY(statesAfter(20, cold)[0] < statesAfter(20, {})[0]);
    QVERIFY(statesAfter(20, dry)[3] > statesAfter(20, {})[3]);
    AgeingParameters birch;
    birch.redness = 0;
    QCOMPARE(statesAfter(60, birch)[2], 0.0);
  }

  void statesMoveOnlyForward() {
    SeasonStates before = statesAfter(0, {});
    QCOMPARE(before[0], 1.0);
    for (double day = 0.5; day < 80; day += 0.5) {
      const SeasonStates now = statesAfter(day, {});
      QVERIFY(std::abs(now[0] + now[1] + now[2] + now[3] - 1) < 1e-9);
      QVERIFY(now[0] <= before[0] && now[3] >= before[3]);
      QVERIFY(now[0] + now[1] <= before[0] + before[1] + 1e-12);
      before = now;
    }
  }

  void noLeafGrowsYounger() {
    for (const double rank : {0.05, 0.3, 0.6, 0.95}) {
      LeafAge before;
      for (double season = 0; season <= 1; season += 0.02) {
        const LeafAge now = ageOfRank(rank, statesAfter(seasonDays(season), {}));
        QVERIFY(now.fading >= before.fading - 1e-9 && now.browning >= before.browning - 1e-9);
        before = now;
      }
    }
    QCOMPARE(ageOfRank(0.99, statesAfter(0, {})).fading, 0.0);
  }

  void sharesOfRanksFollowTheStates() {
    const SeasonStates states = statesAfter(15, {});
    int green = 0, dying = 0;
    for (int i = 0; i < 1000; ++i) {
      const LeafAge age = ageOfRank((i + 0.5) / 1000, states);
      green += age.fading < 0.5;
      dying += age.browning > 0.5;
    }
    QVERIFY2(std::abs(green / 1000.0 - states[0]) < 0.1, qPrintable(QString("%1 %2").arg(green).arg(states[0])));
    QVERIFY2(std::abs(dying / 1000.0 - states[3]) < 0.16, qPrintable(QString("%1 %2").arg(dying).arg(states[3])));
    // At the end no leaf is green.
    for (const double rank : {0.001, 0.5, 0.999}) QVERIFY(ageOfRank(rank, {0, 0, 0, 1}).browning > 0.99);
  }

  void veinsAreTheLastToLoseGreen() {
    const Green leaf;
    AgeingParameters p;
    p.age = 0.25;
    p.redness = 0;
    const QImage aged = agedTexture(leaf.image, leaf.maps.ageing, leafAge(p), p);
    double vein = 0, blade = 0;
    for (int y = 80; y < 220; ++y) {
      vein += greenness(aged.pixel(100, y));
      blade += greenness(aged.pixel(140, y));
    }
    QVERIFY2(vein / 140 > blade / 140 + 8, qPrintable(QString("%1 %2").arg(vein / 140).arg(blade / 140)));
  }

  void brownComesFromTheMargin() {
    const Green leaf;
    AgeingParameters p;
    p.age = 0.72;
    const QImage aged = agedTexture(leaf.image, leaf.maps.ageing, leafAge(p), p);
    // Brown is darker than yellow.
    double margin = 0, middle = 0;
    int n = 0;
    for (int y = 110; y < 190; ++y, ++n) {
      margin += qGray(aged.pixel(19, y));
      middle += qGray(aged.pixel(75, y));
    }
    QVERIFY2(margin / n < middle / n - 15, qPrintable(QString("%1 %2").arg(margin / n).arg(middle / n)));
  }

  void ageGoesFromGreenOverYellowToBrown() {
    const Green leaf;
    AgeingParameters p;
    p.redness = 0;
    const std::array<float, 3> fresh = meanLab(leaf.image);
    const auto at = [&](double age) {
      p.age = age;
      return meanLab(agedTexture(leaf.image, leaf.maps.ageing, leafAge(p), p));
    };
    QVERIFY(std::abs(at(0)[0] - fresh[0]) < 0.6f);
    QVERIFY(at(0.5)[0] > fresh[0] + 10 && at(0.5)[1] > fresh[1] + 10);
    QVERIFY(at(1)[0] < at(0.5)[0] - 15);
    QVERIFY(std::abs(at(1)[0] - ageColours(p)[2][0]) < 4);
    p.redness = 1;
    QVERIFY(at(0.6)[1] > 20);
  }

  void alphaStaysAndNothingHappensAtAgeZero() {
    const Green leaf;
    AgeingParameters p;
    QCOMPARE(agedTexture(leaf.image, leaf.maps.ageing, leafAge(p), p), leaf.image);
    p.age = 0.8;
    const QImage aged = agedTexture(leaf.image, leaf.maps.ageing, leafAge(p), p);
    QCOMPARE(aged.convertToFormat(QImage::Format_Alpha8), leaf.image.convertToFormat(QImage::Format_Alpha8));
  }

  void dryLeavesCurlAndWetOnesLess() {
    LeafAge old;
    old.fading = old.browning = 1;
    QVERIFY(old.dryness(0) > 0.95);
    QVERIFY(old.dryness(1) < old.dryness(0) - 0.2);
    QCOMPARE(LeafAge{}.dryness(0), 0.0);
  }

  void gainsTurnTheMeanColourIntoTheTargets() {
    const Green leaf;
    const auto gains = ageGains(leaf.image, {});
    // Yellow is far more red than this green; brown darker than yellow in every channel but perhaps blue.
    QVERIFY(gains[0][0] > 3);
    QVERIFY(gains[2][0] < gains[0][0] && gains[2][1] < gains[0][1]);
  }
};

WINDFALL_SUITE(LeafAgeingTest)
#include "leaf_ageing.moc"
