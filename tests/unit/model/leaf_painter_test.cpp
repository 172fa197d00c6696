// The painted leaf: sample and fixture of everything that needs a photo.
#include "model/sample/leaf_painter.h"

#include <QtTest>

#include "support/suite.h"

using namespace windfall::model;

class LeafPainterTest : public QObject {
  Q_OBJECT
 private slots:
  void sameSeedGivesTheSameBits() {
    const PaintedLeaf leaf{LeafShape::Oak, 0.5, 0.5};
    const PaintedPhoto first = paintLeafPhoto(leaf, 4, 160), again = paintLeafPhoto(leaf, 4, 160);
    QCOMPARE(first.photo, again.photo);
    QVERIFY(paintLeafPhoto(leaf, 5, 160).photo != first.photo);
  }

  void leafLiesInsideThePaper_data() {
    QTest::addColumn<int>("shape");
    for (int shape = 0; shape < 4; ++shape) QTest::addRow("shape %d", shape) << shape;
  }
  void leafLiesInsideThePaper() {
    QFETCH(int, shape);
    const PaintedPhoto painted = paintLeafPhoto({static_cast<LeafShape>(shape), 0.3, 0.5}, 9, 200);
    const QImage& mask = painted.mask;
    int covered = 0;
    for (int y = 0; y < mask.height(); ++y) {
      for (int x = 0; x < mask.width(); ++x) {
        const bool leaf = mask.constScanLine(y)[x] != 0;
        covered += leaf;
        if (x < 3 || y < 3 || x >= mask.width() - 3 || y >= mask.height() - 3) QVERIFY(!leaf);
      }
    }
    const double share = static_cast<double>(covered) / (mask.width() * mask.height());
    QVERIFY2(share > 0.1 && share < 0.6, qPrintable(QString::number(share)));
    QVERIFY(painted.root.y() > painted.tip.y());
    QVERIFY(QLineF(painted.root, painted.tip).length() > 60);
  }

  void autumnTurnsGreenToYellowAndRed() {
    const auto centre = [](double autumn, double redness) {
      const PaintedPhoto painted = paintLeafPhoto({LeafShape::Ovate, autumn, redness}, 2, 120);
      int red = 0, green = 0;
      for (int y = 0; y < painted.photo.height(); ++y) {
        for (int x = 0; x < painted.photo.width(); ++x) {
          if (painted.mask.constScanLine(y)[x] == 0) continue;
          red += qRed(painted.photo.pixel(x, y));
          green += qGreen(painted.photo.pixel(x, y));
        }
      }
      return static_cast<double>(red) / green;
    };
    QVERIFY(centre(0, 0) < 0.8);
    QVERIFY(centre(0.6, 0) > 1.0);
    QVERIFY(centre(0.8, 1) > centre(0.8, 0) + 0.3);
  }
};

WINDFALL_SUITE(LeafPainterTest)
#include "leaf_painter_test.moc"
