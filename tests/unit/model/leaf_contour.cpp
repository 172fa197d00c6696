#include "model/leaf/contour.h"

#include <QLineF>
#include <QtTest>
#include <algorithm>

#include "model/leaf/axis.h"
#include "support/leaf_fixture.h"
#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;

namespace {

Polygon square(int points) {
  Polygon p;
  const int side = points / 4;
  for (int i = 0; i < points; ++i) {
    const double t = 100.0 * (i % side) / side;
    const int edge = i / side;
    p.emplace_back(edge == 0   ? t
                   : edge == 1 ? 100
                   : edge == 2 ? 100 - t
                               : 0,
                   edge == 0   ? 0
                   : edge == 1 ? t
                   : edge == 2 ? 100
                               : 100 - t);
  }
  return p;
}

double distanceToPolygon(QPointF p, const Polygon& polygon) {
  double best = 1e9;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const QPointF a = polygon[i], d = polygon[(i + 1) % polygon.size()] - a;
    const double t = std::clamp(QPointF::dotProduct(p - a, d) / std::max(1e-12, QPointF::dotProduct(d, d)), 0.0, 1.0);
    best = std::min(best, QLineF(p, a + t * d).length());
  }
  return best;
}

double signedArea(const Polygon& p) {
  double sum = 0;
  for (size_t i = 0; i < p.size(); ++i) {
    const QPointF a = p[i], b = p[(i + 1) % p.size()];
    sum += a.x() * b.y() - b.x() * a.y();
  }
  return sum / 2;
}

}  // namespace

class LeafContour : public QObject {
  Q_OBJECT
 private slots:
  void aSquareOfAThousandPointsHasFourCorners() {
    QCOMPARE(simplifyClosed(square(1000), 0.5, {0, 0}, {100, 100}).size(), size_t{4});
    QVERIFY(mergeCollinear(square(1000)).size() >= 4);
  }

  void theStartDoesNotMatter() {
    const Polygon border = traceBorder(paintLeafPhoto({LeafShape::Oak}, 3, 300).mask);
    Polygon rotated = border;
    std::rotate(rotated.begin(), rotated.begin() + static_cast<std::ptrdiff_t>(border.size() / 3), rotated.end());
    const double epsilon = 1.5;
    const Polygon a = simplifyClosed(border, epsilon, border[0], border[border.size() / 2]);
    const Polygon b = simplifyClosed(rotated, epsilon, rotated[0], rotated[rotated.size() / 2]);
    QVERIFY(a.size() < border.size() / 4);
    for (const QPointF& p : border) {
      QVERIFY(distanceToPolygon(p, a) <= epsilon + 1e-9);
      QVERIFY(distanceToPolygon(p, b) <= epsilon + 1e-9);
    }
  }

  void theBorderRunsOnceRoundCounterClockwise() {
    const Polygon border = traceBorder(test::ellipseMask({120, 90}, {20, 10, 70, 60}));
    QVERIFY(signedArea(border) < 0);  // rows count downwards
    for (size_t i = 0; i < border.size(); ++i) {
      const QPointF step = border[(i + 1) % border.size()] - border[i];
      QVERIFY(std::max(std::abs(step.x()), std::abs(step.y())) == 1);
    }
    QVERIFY(traceBorder(test::ellipseMask({50, 50}, {})).empty());
  }

  void rootAndTipOfPaintedLeavesAreFound_data() {
    QTest::addColumn<int>("shape");
    for (int shape = 0; shape < 4; ++shape) QTest::addRow("shape %d", shape) << shape;
  }
  void rootAndTipOfPaintedLeavesAreFound() {
    QFETCH(int, shape);
    const PaintedPhoto painted = paintLeafPhoto({static_cast<LeafShape>(shape)}, 8, 500);
    const Polygon border = traceBorder(painted.mask);
    const LeafAxis axis = findAxis(painted.mask, border, {});
    const double size = QLineF(painted.root, painted.tip).length();
    QVERIFY(QLineF(axis.root, painted.root).length() < 0.1 * size);
    QVERIFY(!axis.petiole.empty());
    const QPointF given = painted.root + QPointF(4, -9);
    QCOMPARE(findAxis(painted.mask, border, given).root, given);
  }

  void aNarrowBladeHasItsRootAtItsPetiole_data() {
    QTest::addColumn<double>("width");
    for (double width : {34.0, 60.0, 110.0}) QTest::addRow("%g px wide", width) << width;
  }
  void aNarrowBladeHasItsRootAtItsPetiole() {
    QFETCH(double, width);
    for (const bool petioleLeft : {true, false}) {
      const QImage mask = test::willowMask(width, petioleLeft);
      const Polygon border = traceBorder(mask);
      const LeafAxis axis = findAxis(mask, border, {});
      QVERIFY(!axis.petiole.empty());
      const QPointF base = petioleLeft ? QPointF(100, 150) : QPointF(900, 150);
      QVERIFY2(QLineF(axis.root, base).length() < 50, qPrintable(QString::number(axis.root.x())));
      QVERIFY(std::abs(axis.tip.x() - (petioleLeft ? 900 : 100)) < 20);
    }
  }
};

WINDFALL_SUITE(LeafContour)
#include "leaf_contour.moc"
