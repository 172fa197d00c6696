// Several leaves in one mask: those that touch come apart, lobes and leaflets stay together.
#include <QDir>
#include <QPainter>
#include <QtTest>
#include <cmath>

#include "model/leaf/mask.h"
#include "model/leaf/mask_edit.h"
#include "support/leaf_fixture.h"
#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;

namespace {

constexpr double kUp = -M_PI / 2;

/// A blade from its base, pointed at both ends.
QPolygonF blade(QPointF base, double angle, double length, double width) {
  QPolygonF outline;
  const QTransform place = QTransform().translate(base.x(), base.y()).rotateRadians(angle);
  for (int side : {1, -1}) {
    for (int i = 0; i <= 60; ++i) {
      const double t = side > 0 ? i / 60.0 : 1 - i / 60.0;
      outline << place.map(QPointF(t * length, side * width / 2 * std::sin(M_PI * std::pow(t, 0.8))));
    }
  }
  return outline;
}

/// White shapes on black, as a photo: a bare mask.
class Sheet {
 public:
  Sheet() : image_(700, 700, QImage::Format_RGBA8888) {
    image_.fill(Qt::black);
    painter_.begin(&image_);
    painter_.setBrush(Qt::white);
  }
  Sheet& blade(QPointF base, double angle, double length, double width) {
    painter_.setPen(Qt::NoPen);
    painter_.drawPolygon(::blade(base, angle, length, width));
    return *this;
  }
  Sheet& round(QRectF box) {
    painter_.setPen(Qt::NoPen);
    painter_.drawEllipse(box);
    return *this;
  }
  Sheet& line(QPointF a, QPointF b, double width, QColor colour = Qt::white) {
    painter_.setPen(QPen(colour, width));
    painter_.drawLine(a, b);
    return *this;
  }
  std::vector<QImage> leaves() {
    painter_.end();
    const QImage mask = bareMask(image_.convertToFormat(QImage::Format_RGBA8888));
    return mask.isNull() ? std::vector<QImage>() : separateLeaves(image_, mask);
  }

 private:
  QImage image_;
  QPainter painter_;
};

}  // namespace

class LeafTouching : public QObject {
  Q_OBJECT
 private slots:
  void leavesThatTouchComeApart() {
    QCOMPARE(Sheet().blade({200, 600}, kUp, 460, 200).blade({394, 620}, kUp + 0.05, 450, 200).leaves().size(), 2U);
    QCOMPARE(Sheet().blade({200, 650}, kUp, 460, 240).blade({312, 400}, 0.2, 320, 200).leaves().size(), 2U);
    QCOMPARE(Sheet().round({20, 200, 300, 280}).round({312, 240, 260, 260}).leaves().size(), 2U);
    QCOMPARE(Sheet()
                 .blade({130, 600}, kUp, 400, 190)
                 .blade({317, 600}, kUp, 420, 190)
                 .blade({504, 600}, kUp, 380, 190)
                 .leaves()
                 .size(),
             3U);
  }

  void eachGetsItsOwnMask() {
    const QImage alone = Sheet().blade({200, 600}, kUp, 460, 200).line({200, 690}, {200, 590}, 7).leaves().front();
    const std::vector<QImage> leaves = Sheet()
                                           .blade({200, 600}, kUp, 460, 200)
                                           .line({200, 690}, {200, 590}, 7)
                                           .blade({396, 620}, kUp + 0.05, 430, 200)
                                           .leaves();
    QCOMPARE(leaves.size(), 2U);
    QVERIFY2(test::overlap(leaves[0], alone) > 0.99, qPrintable(QString::number(test::overlap(leaves[0], alone))));
    QVERIFY(test::overlap(leaves[0], leaves[1]) == 0);
  }

  void lobesAndLeafletsStayTogether_data() {
    QTest::addColumn<int>("stalk");
    for (int stalk : {4, 8, 14}) QTest::addRow("stalk %d px", stalk) << stalk;
  }
  void lobesAndLeafletsStayTogether() {
    QFETCH(int, stalk);
    Sheet pinnate, trifoliate, palmate, twoLobes, eaten;
    pinnate.line({350, 680}, {350, 130}, stalk).blade({350, 160}, kUp, 140, 90);
    for (int y : {580, 450, 320, 200}) {
      for (int side : {-1, 1}) pinnate.blade({350.0, double(y)}, kUp + side * 1.1, 190, 90);
    }
    QCOMPARE(pinnate.leaves().size(), 1U);
    trifoliate.line({350, 680}, {350, 390}, stalk);
    for (double angle : {0.0, -1.5, 1.5}) trifoliate.blade({350, 400}, kUp + angle, 290, 190);
    QCOMPARE(trifoliate.leaves().size(), 1U);
    palmate.line({350, 680}, {350, 400}, stalk).round({300, 380, 100, 110});
    for (int i = -2; i <= 2; ++i) palmate.blade({350, 450}, kUp + 0.75 * i, 330 - 40 * std::abs(i), 140);
    QCOMPARE(palmate.leaves().size(), 1U);
    twoLobes.line({350, 680}, {350, 460}, stalk).blade({350, 470}, kUp - 0.6, 370, 210);
    QCOMPARE(twoLobes.blade({350, 470}, kUp + 0.6, 370, 210).leaves().size(), 1U);
    // Bitten from both sides, a bridge of it left along the midrib.
    eaten.blade({350, 680}, kUp, 620, 360).line({40, 390}, {350.0 - 2 * stalk - 80, 390}, 170, Qt::black);
    QCOMPARE(eaten.line({660, 400}, {350.0 + 2 * stalk + 80, 400}, 160, Qt::black).leaves().size(), 1U);
  }

  void noRealLeafIsCut() {
    const QString folder = test::sharedData("masks");
    if (folder.isEmpty()) QSKIP("shared/data/masks is absent");
    for (const QFileInfo& file : QDir(folder).entryInfoList({"*.png"})) {
      const QImage mask =
          QImage(file.filePath()).scaled(600, 600, Qt::KeepAspectRatio).convertToFormat(QImage::Format_Grayscale8);
      QVERIFY(!mask.isNull());
      QVERIFY2(separateLeaves(mask.convertToFormat(QImage::Format_RGBA8888), mask).size() == 1,
               qPrintable(file.fileName()));
    }
  }

  void paintedLeavesOfEveryShapeAreOne() {
    for (int shape = 0; shape < 4; ++shape) {
      const PaintedPhoto painted = paintLeafPhoto({static_cast<LeafShape>(shape)}, 5, 300);
      QCOMPARE(separateLeaves(painted.photo.convertToFormat(QImage::Format_RGBA8888), painted.mask).size(), 1U);
    }
  }

  void aCutByHandPartsLeavesToo() {
    // Overlapping too much for anyone to be sure; a stroke of the eraser says where one ends.
    Sheet sheet;
    sheet.blade({200, 600}, kUp, 460, 240).blade({330, 620}, kUp, 450, 240);
    sheet.line({265, 60}, {265, 690}, 3, Qt::black);
    QCOMPARE(sheet.leaves().size(), 2U);
  }

  void cutoutsOfOnePictureAreSeveralLeaves() {
    QImage image(500, 300, QImage::Format_RGBA8888);
    image.fill(Qt::transparent);
    QPainter painter(&image);
    painter.setPen(Qt::NoPen);
    painter.setBrush(QColor(40, 110, 50));
    painter.drawPolygon(blade({120, 280}, kUp, 260, 130));
    painter.drawPolygon(blade({350, 280}, kUp, 230, 110));
    painter.end();
    Progress progress;
    const Result<QImage> mask = automaticMask(image, {}, progress);
    QVERIFY(mask);
    QCOMPARE(separateLeaves(image, *mask).size(), 2U);
  }
};

WINDFALL_SUITE(LeafTouching)
#include "leaf_touching.moc"
