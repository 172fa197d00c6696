#include "widgets/plant/frequency.h"

#include <QtTest>
#include <cmath>
#include <numbers>
#include <vector>

#include "support/suite.h"

using windfall::widgets::dominantFrequency;

class FrequencyTest : public QObject {
  Q_OBJECT
  static std::vector<float> wave(double hertz, double interval, int count, double drift = 0) {
    std::vector<float> samples;
    for (int i = 0; i < count; ++i) {
      samples.push_back(static_cast<float>(std::sin(2 * std::numbers::pi * hertz * i * interval) + drift * i));
    }
    return samples;
  }

 private slots:
  void findsTheFrequencyOfAWave_data() {
    QTest::addColumn<double>("hertz");
    QTest::newRow("slow") << 0.31;
    QTest::newRow("between bins") << 1.234;
    QTest::newRow("fast") << 6.7;
  }
  void findsTheFrequencyOfAWave() {
    QFETCH(double, hertz);
    const double found = dominantFrequency(wave(hertz, 1.0 / 30, 600), 1.0 / 30);
    QVERIFY2(std::abs(found - hertz) < 0.01, qPrintable(QString::number(found)));
  }

  void strongerOfTwoWins() {
    std::vector<float> sum = wave(0.8, 1.0 / 30, 600);
    const std::vector<float> other = wave(3.1, 1.0 / 30, 600);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += 0.5f * other[i];
    QVERIFY(std::abs(dominantFrequency(sum, 1.0 / 30) - 0.8) < 0.01);
  }

  void leanDoesNotCount() {
    std::vector<float> samples = wave(1.5, 1.0 / 30, 600);
    for (float& sample : samples) sample += 40;
    QVERIFY(std::abs(dominantFrequency(samples, 1.0 / 30) - 1.5) < 0.02);
  }

  void stillnessAndShortRecordsHaveNone() {
    QCOMPARE(dominantFrequency(std::vector<float>(400, 0.25f), 1.0 / 30), 0.0);
    QCOMPARE(dominantFrequency(wave(1, 1.0 / 30, 20), 1.0 / 30), 0.0);
    QCOMPARE(dominantFrequency({}, 1.0 / 30), 0.0);
  }
};

WINDFALL_SUITE(FrequencyTest)
#include "frequency.moc"
