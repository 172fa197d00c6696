#include <QLineF>
#include <QPainter>
#include <QtTest>
#include <cmath>

#include "model/leaf/vein_growth.h"
#include "support/leaf_fixture.h"
#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;

namespace {

Veins veinsOf(const PaintedPhoto& painted, quint64 seed) {
  const Polygon border = traceBorder(painted.mask);
  VeinParameters parameters;
  parameters.seed = seed;
  return growVeins(painted.mask, border, findAxis(painted.mask, border, {}), {}, parameters);
}

}  // namespace

class LeafVeins : public QObject {
  Q_OBJECT
 private slots:
  void aWalkOfTwentyStepLengthsTakesTwentySixSteps() {
    double total = 0;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
      RandomSequence random(seed);
      const Polygon walk = growWalk({0, 0}, {200, 0}, 10, 30, random);
      QCOMPARE(walk.front(), QPointF(0, 0));
      QCOMPARE(walk.back(), QPointF(200, 0));
      total += static_cast<double>(walk.size() - 1);
    }
    const double mean = total / 200;
    QVERIFY2(mean > 24 && mean < 28, qPrintable(QString::number(mean)));
  }

  void veinsLieInTheLeafAndLateralsDoNotCross_data() {
    QTest::addColumn<int>("shape");
    for (int shape = 0; shape < 4; ++shape) QTest::addRow("shape %d", shape) << shape;
  }
  void veinsLieInTheLeafAndLateralsDoNotCross() {
    QFETCH(int, shape);
    const PaintedPhoto painted = paintLeafPhoto({static_cast<LeafShape>(shape)}, 12, 400);
    for (const quint64 seed : {1, 2, 3}) {
      const Veins veins = veinsOf(painted, seed);
      QVERIFY(veins.size() > 5);
      QCOMPARE(veins[0].order, 1);
      for (size_t i = 0; i < veins.size(); ++i) {
        for (const QPointF& p : veins[i].points) {
          QVERIFY(painted.mask.valid(p.toPoint()));
          QVERIFY(painted.mask.pixelColor(p.toPoint()).red() > 0);
        }
        for (size_t k = 0; k < i; ++k) {
          if (veins[i].order < 2 || veins[k].order < 2) continue;
          for (size_t a = 1; a < veins[i].points.size(); ++a) {
            const QLineF one(veins[i].points[a - 1], veins[i].points[a]);
            for (size_t b = 1; b < veins[k].points.size(); ++b) {
              const QLineF other(veins[k].points[b - 1], veins[k].points[b]);
              QVERIFY(one.intersects(other, nullptr) != QLineF::BoundedIntersection);
            }
          }
        }
      }
    }
  }

  void everyLobeOfAPalmateLeafHasAMainVein_data() {
    QTest::addColumn<QList<double>>("angles");   // of the lobes, degrees from the tip
    QTest::addColumn<QList<double>>("lengths");  // beside the middle one's
    QTest::newRow("five, the lower ones short")
        << QList<double>{-74, -40, 0, 40, 74} << QList<double>{0.5, 0.75, 1, 0.75, 0.5};
    QTest::newRow("five, lobes close together")
        << QList<double>{-62, -38, 0, 38, 62} << QList<double>{0.62, 0.75, 1, 0.75, 0.62};
    QTest::newRow("three") << QList<double>{-45, 0, 45} << QList<double>{0.8, 1, 0.8};
  }
  void everyLobeOfAPalmateLeafHasAMainVein() {
    QFETCH(QList<double>, angles);
    QFETCH(QList<double>, lengths);
    const QPointF root(300, 460);
    const auto at = [&](double angle, double length) {
      const double a = angle * M_PI / 180;
      return root + 380 * length * QPointF(std::sin(a), -std::cos(a));
    };
    QPolygonF outline{root + QPointF(-20, 12)};
    for (qsizetype i = 0; i < angles.size(); ++i) {
      if (i > 0) outline << at(0.5 * (angles[i] + angles[i - 1]), 0.45 * std::min(lengths[i], lengths[i - 1]));
      outline << at(angles[i], lengths[i]);
    }
    outline << root + QPointF(20, 12);
    PaintedPhoto leaf;
    leaf.mask = QImage(600, 520, QImage::Format_Grayscale8);
    leaf.mask.fill(0);
    QPainter painter(&leaf.mask);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(Qt::NoPen);
    painter.setBrush(Qt::white);
    painter.drawPolygon(outline);
    painter.drawRect(QRectF(296, 455, 8, 60));
    painter.end();
    const Veins veins = veinsOf(leaf, 3);
    for (qsizetype i = 0; i < angles.size(); ++i) {
      const bool has = std::any_of(veins.begin(), veins.end(), [&](const Vein& vein) {
        return vein.order == 1 && QLineF(vein.points.back(), at(angles[i], lengths[i])).length() < 12;
      });
      QVERIFY2(has, qPrintable(QString::number(angles[i])));
    }
    QCOMPARE(std::count_if(veins.begin(), veins.end(), [](const Vein& vein) { return vein.order == 1; }),
             angles.size());
  }

  void aNarrowBladeHasItsLateralsToo() {
    for (const double width : {34.0, 60.0}) {
      const QImage mask = test::willowMask(width, true);
      const Polygon border = traceBorder(mask);
      const Veins veins = growVeins(mask, border, findAxis(mask, border, {}), {}, {});
      const auto laterals = std::count_if(veins.begin(), veins.end(), [](const Vein& v) { return v.order == 2; });
      QVERIFY2(laterals >= 12, qPrintable(QString::number(laterals)));
      // Finer than those of a broad blade of its length.
      QVERIFY(veins[0].startWidth < 0.12 * width);
    }
  }

  void theSeedDecides() {
    const PaintedPhoto painted = paintLeafPhoto({}, 12, 300);
    QCOMPARE(veinsOf(painted, 5), veinsOf(painted, 5));
    QVERIFY(veinsOf(painted, 5) != veinsOf(painted, 6));
  }

  void drawnVeinsFollowTheFrame() {
    const Veins veins{{1, -1, {{10, 10}, {10, 30}}, 2, 2}};
    const QImage drawn = drawVeins(veins, {40, 60}, {5, 5}, 2);
    QVERIFY(drawn.pixelColor(10, 30).red() > 200);
    QCOMPARE(drawn.pixelColor(30, 30).red(), 0);
  }
};

WINDFALL_SUITE(LeafVeins)
#include "leaf_veins.moc"
