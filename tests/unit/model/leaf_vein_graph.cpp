// Veins as a graph: curves, edits, finer veins, and pictures of veins read back.
#include "model/leaf/vein_graph.h"

#include <QLineF>
#include <QPainter>
#include <QtTest>
#include <cmath>

#include "model/leaf/vein_curve.h"
#include "model/leaf/vein_growth.h"
#include "model/leaf/vein_micro.h"
#include "model/leaf/vein_tracing.h"
#include "support/leaf_fixture.h"
#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;

namespace {

/// A main vein, a lateral on it, a tertiary on that.
Veins threeOrders() {
  return {{1, -1, {{100, 200}, {100, 120}, {100, 20}}, 4, 2},
          {2, 0, {{100, 120}, {150, 80}, {170, 70}}, 2, 1},
          {3, 1, {{150, 80}, {152, 60}}, 1, 0.5}};
}

double bernstein(int n, int k, double t) {
  double choose = 1;
  for (int i = 1; i <= k; ++i) choose = choose * (n - k + i) / i;
  return choose * std::pow(t, k) * std::pow(1 - t, n - k);
}

}  // namespace

class LeafVeinGraph : public QObject {
  Q_OBJECT
 private slots:
  void deCasteljauIsTheBernsteinSum() {
    RandomSequence random(5);
    Polygon control;
    for (int i = 0; i < 12; ++i) control.emplace_back(random.uniform(0, 300), random.uniform(0, 300));
    for (int step = 0; step <= 20; ++step) {
      const double t = step / 20.0;
      QPointF sum;
      for (int k = 0; k < 12; ++k) sum += bernstein(11, k, t) * control[static_cast<size_t>(k)];
      QVERIFY(QLineF(sum, deCasteljau(control, t)).length() < 1e-6);
    }
    QCOMPARE(deCasteljau(control, 0), control.front());
    QCOMPARE(bezierCurve(control).front(), control.front());
    QCOMPARE(bezierCurve(control).back(), control.back());
  }

  void aCurveThroughPointsPassesAllOfThem() {
    const Polygon points{{0, 0}, {40, 10}, {45, 60}, {120, 90}};
    const Polygon curve = throughPoints(points);
    QVERIFY(curve.size() > 40);
    for (const QPointF& p : points) QVERIFY(std::find(curve.begin(), curve.end(), p) != curve.end());
    for (size_t i = 1; i < curve.size(); ++i) QVERIFY(QLineF(curve[i - 1], curve[i]).length() < 5);
  }

  void aNewVeinLeavesTheNearestOne() {
    const Veins veins = withVein(threeOrders(), {{103, 60}, {60, 40}, {40, 35}}, 2, 1, 10);
    QCOMPARE(veins.size(), size_t(4));
    QCOMPARE(veins[3].parent, 0);
    QCOMPARE(veins[3].order, 2);
    QCOMPARE(veins[3].points.front(), QPointF(100, 60));
    QCOMPARE(withVein({}, {{0, 0}, {9, 9}}, 2, 1, 10).front().order, 1);
    QCOMPARE(withVein(threeOrders(), {{500, 500}, {600, 500}}, 2, 1, 10)[3].parent, -1);
  }

  void movingAPointTakesItsChildrenAlong() {
    const Veins veins = withMovedPoint(threeOrders(), 0, 1, {110, 130});
    QCOMPARE(veins[0].points[1], QPointF(110, 130));
    QCOMPARE(veins[1].points.front(), QPointF(110, 130));
    QCOMPARE(veins[1].points[1], QPointF(150, 80));
    const Veins lateral = withMovedPoint(threeOrders(), 1, 1, {150, 90});
    QCOMPARE(lateral[2].points.front(), QPointF(150, 90));
  }

  void pointsAndVeinsComeAndGo() {
    Veins veins = withPoint(threeOrders(), 0, 0, {98, 160});
    QCOMPARE(veins[0].points.size(), size_t(4));
    QCOMPARE(veins[0].points[1], QPointF(98, 160));
    veins = withoutPoint(veins, 0, 1);
    QCOMPARE(veins, threeOrders());
    // A vein that two points are left of goes with all that leaves it.
    QCOMPARE(withoutPoint(threeOrders(), 2, 0).size(), size_t(2));
    QCOMPARE(withoutVein(threeOrders(), 1).size(), size_t(1));
    QCOMPARE(withoutVein(threeOrders(), 2).size(), size_t(2));
    Veins gap = threeOrders();
    gap.insert(gap.begin(), {1, -1, {{0, 0}, {5, 5}}, 1, 1});
    gap[2].parent = 1;
    gap[3].parent = 2;
    const Veins left = withoutVein(gap, 0);
    QCOMPARE(left[1].parent, 0);
    QCOMPARE(left[2].parent, 1);
    QCOMPARE(withoutVein(threeOrders(), 9), threeOrders());
  }

  void widthAndOrderAreEdited() {
    QCOMPARE(withWidth(threeOrders(), 1, 2)[1].startWidth, 4.0);
    QCOMPARE(withWidth(threeOrders(), 2, 1e-9)[2].endWidth, 0.25);
    const Veins veins = withOrder(threeOrders(), 1, 3);
    QCOMPARE(veins[1].order, 3);
    QCOMPARE(veins[2].order, 4);
    QCOMPARE(veins[0].order, 1);
  }

  void editableVeinsHaveFewPointsAndTheSameCourse() {
    const PaintedPhoto painted = paintLeafPhoto({}, 12, 300);
    const Polygon border = traceBorder(painted.mask);
    const Veins veins = growVeins(painted.mask, border, findAxis(painted.mask, border, {}), {}, {});
    const Veins sparse = editableVeins(veins, 0.5);
    QCOMPARE(sparse.size(), veins.size());
    size_t before = 0, after = 0;
    for (size_t i = 0; i < veins.size(); ++i) {
      before += veins[i].points.size();
      after += sparse[i].points.size();
      const Veins one{sparse[i]};
      for (const QPointF& p : veins[i].points) QVERIFY(nearestVein(one, p, 0.6).has_value());
    }
    QVERIFY2(after * 4 < before, qPrintable(QString("%1 of %2").arg(after).arg(before)));
  }

  void finerVeinsFillTheLeafAndStayOnIt_data() {
    QTest::addColumn<bool>("closed");
    QTest::newRow("open") << false;
    QTest::newRow("closed") << true;
  }
  void finerVeinsFillTheLeafAndStayOnIt() {
    QFETCH(bool, closed);
    const PaintedPhoto painted = paintLeafPhoto({}, 12, 300);
    const Polygon border = traceBorder(painted.mask);
    VeinParameters parameters;
    parameters.micro = true;
    parameters.closed = closed;
    parameters.microSpacing = 0.04;
    const LeafAxis axis = findAxis(painted.mask, border, {});
    const Veins veins = growVeins(painted.mask, border, axis, {}, parameters);
    QCOMPARE(growVeins(painted.mask, border, axis, {}, parameters), veins);
    size_t fine = 0;
    for (size_t i = 0; i < veins.size(); ++i) {
      const Vein& vein = veins[i];
      QVERIFY(vein.parent < static_cast<int>(i));
      if (vein.order < kTertiaryOrder) continue;
      ++fine;
      QVERIFY(vein.parent >= 0);
      QVERIFY(nearestVein({veins[static_cast<size_t>(vein.parent)]}, vein.points.front(), 1.5).has_value());
      for (const QPointF& p : vein.points) QVERIFY(painted.mask.pixelColor(p.toPoint()).red() > 0);
    }
    QVERIFY2(fine > 60, qPrintable(QString::number(fine)));
    // No tissue is far from a vein.
    double worst = 0;
    for (int y = 0; y < 300; y += 9) {
      for (int x = 0; x < painted.mask.width(); x += 9) {
        if (!painted.mask.valid(x, y) || painted.mask.pixelColor(x, y).red() == 0) continue;
        const auto near = nearestVein(veins, QPointF(x, y), 1e9);
        worst = std::max(worst, near->distance);
      }
    }
    QVERIFY2(worst < 2.5 * 0.04 * 300, qPrintable(QString::number(worst)));
  }

  void closedVeinsMeetAndOpenOnesDoNot() {
    const PaintedPhoto painted = paintLeafPhoto({}, 12, 260);
    const Polygon border = traceBorder(painted.mask);
    const LeafAxis axis = findAxis(painted.mask, border, {});
    const auto meetings = [&](bool closed) {
      VeinParameters parameters;
      parameters.micro = true;
      parameters.closed = closed;
      parameters.microSpacing = 0.05;
      const Veins veins = growVeins(painted.mask, border, axis, {}, parameters);
      int count = 0;
      for (size_t i = 0; i < veins.size(); ++i) {
        for (size_t k = 0; k < i; ++k) {
          if (veins[i].order < kTertiaryOrder || veins[k].order < kTertiaryOrder) continue;
          count += veins[i].points.back() == veins[k].points.back();
        }
      }
      return count;
    };
    QCOMPARE(meetings(false), 0);
    QVERIFY(meetings(true) > 10);
  }

  void aPictureOfVeinsIsReadBack() {
    Veins drawn{{1, -1, {{100, 190}, {104, 110}, {100, 10}}, 5, 3},
                {2, 0, {{103, 130}, {160, 90}}, 3, 2},
                {2, 0, {{102, 60}, {40, 30}}, 3, 2}};
    for (const bool inverted : {false, true}) {
      QImage picture = drawVeins(drawn, {200, 200}, {0, 0}, 1);
      if (inverted) picture.invertPixels();
      const Veins read = readVeinPicture(picture, {{100, 195}, {100, 5}, {}});
      QCOMPARE(read.size(), size_t(3));
      QCOMPARE(read[0].order, 1);
      QCOMPARE(read[0].points.front(), QPointF(100, 195));
      for (const Vein& vein : read) {
        if (&vein != &read[0]) QCOMPARE(vein.order, 2);
        for (const QPointF& p : vein.points) QVERIFY(nearestVein(drawn, p, 8).has_value());
      }
      QVERIFY(QLineF(read[0].points.back(), {100, 10}).length() < 6);
      QVERIFY(std::abs(read[0].startWidth - 5) < 2);
    }
    QVERIFY(readVeinPicture(QImage(drawVeins({}, {50, 50}, {0, 0}, 1)), {{5, 5}, {9, 9}, {}}).empty());
  }

  void veinsOfAPhotoAreThePaintedOnes() {
    const PaintedPhoto painted = paintLeafPhoto({}, 4, 400);
    const QImage photo = painted.photo.convertToFormat(QImage::Format_RGBA8888);
    const LeafAxis axis{painted.root, painted.tip, {}};
    const Veins veins = photoVeins(photo, painted.mask, photo.rect(), axis, 0.004);
    QVERIFY(veins.size() > 4);
    QCOMPARE(veins[0].parent, -1);
    // The main vein runs from the root to near the tip.
    QCOMPARE(veins[0].points.front(), painted.root);
    QVERIFY(QLineF(veins[0].points.back(), painted.tip).length() < 0.2 * QLineF(painted.root, painted.tip).length());
    QVERIFY(photoVeins(photo, painted.mask, photo.rect(), axis, 0.02).size() < veins.size());
  }

  void asManyMainVeinsAsAreWanted() {
    const PaintedPhoto painted = paintLeafPhoto({}, 12, 300);
    const Polygon border = traceBorder(painted.mask);
    const LeafAxis axis = findAxis(painted.mask, border, {});
    for (const int mains : {1, 3, 5}) {
      VeinParameters parameters;
      parameters.mains = mains;
      const Veins veins = growVeins(painted.mask, border, axis, {}, parameters);
      QCOMPARE(static_cast<int>(std::count_if(veins.begin(), veins.end(), [](const Vein& v) { return v.order == 1; })),
               mains);
    }
    const Polygon tips{axis.tip, border[border.size() / 3]};
    const Veins given = growVeins(painted.mask, border, axis, tips, {});
    QCOMPARE(given[1].order, 1);
    QCOMPARE(given[1].points.back(), tips[1]);
  }

  void lateralsKeepToTheirSidesAndSpan() {
    const PaintedPhoto painted = paintLeafPhoto({}, 12, 300);
    const Polygon border = traceBorder(painted.mask);
    const LeafAxis axis = findAxis(painted.mask, border, {});
    VeinParameters parameters;
    parameters.leftSide = false;
    parameters.firstLateral = 0.3;
    parameters.lastLateral = 0.7;
    const Veins veins = growVeins(painted.mask, border, axis, {}, parameters);
    const QLineF along(axis.root, axis.tip);
    QVERIFY(veins.size() > 3);
    for (const Vein& vein : veins) {
      if (vein.order != 2) continue;
      const QPointF d = along.p2() - along.p1();
      const QPointF from = vein.points.front() - along.p1(), to = vein.points.back() - vein.points.front();
      const double share = QPointF::dotProduct(from, d) / QPointF::dotProduct(d, d);
      QVERIFY2(share > 0.2 && share < 0.8, qPrintable(QString::number(share)));
      QVERIFY(d.x() * to.y() - d.y() * to.x() > 0);
    }
  }
};

WINDFALL_SUITE(LeafVeinGraph)
#include "leaf_vein_graph.moc"
