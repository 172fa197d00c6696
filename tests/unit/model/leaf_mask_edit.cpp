// Masks by hand: grown, filled, scribbled, split; and what the shared photos ask of them.
#include "model/leaf/mask_edit.h"

#include <QDir>
#include <QPainter>
#include <QtTest>
#include <cmath>

#include "model/leaf/mask.h"
#include "model/leaf/stages.h"
#include "support/leaf_fixture.h"
#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;

namespace {

int whiteOf(const QImage& mask) {
  int count = 0;
  for (int y = 0; y < mask.height(); ++y) {
    for (int x = 0; x < mask.width(); ++x) count += mask.constScanLine(y)[x] > 127;
  }
  return count;
}

QImage rgba(const QImage& image) { return image.convertToFormat(QImage::Format_RGBA8888); }

QImage photoOf(const QString& name) {
  const QFileInfoList files = QDir(test::sharedData("photos")).entryInfoList({name + ".*"});
  if (files.size() != 1) return {};
  const Result<SourceFile> source = readSourceFile(files[0].filePath());
  if (!source) return {};
  Result<QImage> photo = readPhoto(*source);
  return photo ? *photo : QImage();
}

}  // namespace

class LeafMaskEdit : public QObject {
  Q_OBJECT
 private slots:
  void growsAndShrinks() {
    const QImage mask = test::ellipseMask({120, 100}, {20, 20, 80, 60});
    const QImage wider = grownMask(mask, 4), narrower = grownMask(mask, -4);
    QVERIFY(wider.pixelColor(17, 50).red() > 127 && mask.pixelColor(17, 50).red() < 128);
    QVERIFY(narrower.pixelColor(22, 50).red() < 128 && mask.pixelColor(22, 50).red() > 127);
    QVERIFY(test::overlap(grownMask(wider, -4), mask) > 0.97);
    QImage full(30, 20, QImage::Format_Grayscale8);
    full.fill(255);
    QCOMPARE(int(grownMask(full, -2).constScanLine(1)[5]), 0);
  }

  void invertsTwiceToItself() {
    const QImage mask = test::ellipseMask({60, 40}, {10, 10, 30, 20});
    QCOMPARE(invertedMask(invertedMask(mask)), mask);
    QCOMPARE(int(invertedMask(mask).constScanLine(1)[1]), 255);
  }

  void fillsHolesAndFloods() {
    QImage mask = test::ellipseMask({120, 100}, {10, 10, 100, 80});
    QImage photo(mask.size(), QImage::Format_RGBA8888);
    photo.fill(QColor(220, 215, 205));
    {
      QPainter painter(&photo);
      painter.setPen(Qt::NoPen);
      painter.setBrush(QColor(60, 120, 40));
      painter.drawEllipse(10, 10, 100, 80);
      painter.setBrush(QColor(120, 60, 30));
      painter.drawEllipse(50, 40, 14, 14);
      QPainter hole(&mask);
      hole.setPen(Qt::NoPen);
      hole.setBrush(Qt::black);
      hole.drawEllipse(50, 40, 14, 14);
    }
    QCOMPARE(int(filledMask(mask).constScanLine(47)[57]), 255);
    // A click in the hole fills it and nothing else; a click on ground with Ctrl changes nothing there.
    const QImage flooded = floodedMask(mask, photo, {57, 47}, 14, 255);
    QCOMPARE(int(flooded.constScanLine(47)[57]), 255);
    QCOMPARE(int(flooded.constScanLine(2)[2]), 0);
    QCOMPARE(floodedMask(mask, photo, {2, 2}, 14, 0), mask);
    QCOMPARE(floodedMask(mask, photo, {-5, 400}, 14, 0), mask);
  }

  void aScribbleBringsAMissingPartBack() {
    const PaintedPhoto painted = paintLeafPhoto({}, 7, 360);
    const QImage photo = rgba(painted.photo);
    QImage broken = painted.mask.copy();
    const QPointF middle = 0.5 * (painted.root + painted.tip);
    {
      QPainter painter(&broken);
      painter.fillRect(QRectF(middle, QSizeF(200, 70)), Qt::black);
    }
    const double before = test::overlap(broken, painted.mask);
    const Scribble scribble{{middle + QPointF(12, 20), middle + QPointF(45, 40)}, 12, true};
    const QImage refined = refinedMask(broken, photo, {scribble});
    const double after = test::overlap(refined, painted.mask);
    QVERIFY2(before < 0.93 && after > 0.97, qPrintable(QString("%1 to %2").arg(before).arg(after)));
    QCOMPARE(refinedMask(broken, photo, {scribble}), refined);
    QCOMPARE(refinedMask(broken, photo, {}), broken);
  }

  void shadowsRulersAndNeighboursNeedAtMostOneStroke_data() {
    QTest::addColumn<int>("shape");
    for (int shape = 0; shape < 4; ++shape) QTest::addRow("shape %d", shape) << shape;
  }
  void shadowsRulersAndNeighboursNeedAtMostOneStroke() {
    QFETCH(int, shape);
    const PaintedPhoto painted = paintLeafPhoto({static_cast<LeafShape>(shape), 0.2, 0.7}, 17, 400);
    QImage photo = rgba(painted.photo);
    const QColor paper = photo.pixelColor(4, photo.height() / 2);
    // A hard shadow beside the leaf, in uneven light.
    for (int y = 0; y < photo.height(); ++y) {
      for (int x = 0; x < photo.width(); ++x) {
        const QPoint from(x - 14, y - 8);
        const bool leaf = painted.mask.constScanLine(y)[x] > 127;
        const bool shadow = !leaf && painted.mask.valid(from) && painted.mask.constScanLine(from.y())[from.x()] > 127;
        const double light = (shadow ? 0.6 : 1.0) * (1 - 0.25 * x / photo.width());
        for (int c = 0; c < 3; ++c) {
          uchar& value = photo.scanLine(y)[4 * x + c];
          value = static_cast<uchar>(value * light);
        }
      }
    }
    QPainter painter(&photo);
    // A printed ruler along the lower edge, and a bit of a neighbour in a corner.
    painter.fillRect(10, photo.height() - 16, photo.width() - 20, 12, paper.lighter(112));
    for (int x = 12; x < photo.width() - 12; x += 6) painter.fillRect(x, photo.height() - 16, 1, 7, Qt::black);
    painter.setBrush(QColor(66, 110, 44));
    painter.setPen(Qt::NoPen);
    painter.drawEllipse(QPoint(0, 0), 34, 26);
    painter.end();
    Progress progress;
    const Result<QImage> found = automaticMask(photo, {}, progress);
    QVERIFY2(found, found ? "" : found.error().message.c_str());
    double iou = test::overlap(*found, painted.mask);
    if (iou < 0.85) {
      // One stroke along the shadow says that it is none of the leaf.
      Scribble stroke{{}, 6, false};
      const QPointF middle = 0.5 * (painted.root + painted.tip);
      for (double t = 0; t < 200; t += 4) {
        const QPoint p = (middle + QPointF(t, 0)).toPoint();
        if (!painted.mask.valid(p)) break;
        if (painted.mask.constScanLine(p.y())[p.x()] > 127) continue;
        stroke.points = {p + QPointF(4, -30), p + QPointF(7, 0), p + QPointF(4, 40)};
        break;
      }
      iou = test::overlap(refinedMask(*found, photo, {stroke}), painted.mask);
    }
    QVERIFY2(iou >= 0.85, qPrintable(QString::number(iou)));
  }

  void severalLeavesBecomeSeveralMasks() {
    const PaintedPhoto one = paintLeafPhoto({}, 3, 220), two = paintLeafPhoto({static_cast<LeafShape>(1)}, 8, 200);
    QImage sheet(480, 260, QImage::Format_RGBA8888);
    sheet.fill(rgba(one.photo).pixelColor(3, 3));
    QPainter painter(&sheet);
    painter.drawImage(10, 20, one.photo);
    painter.drawImage(250, 30, two.photo);
    painter.end();
    Progress progress;
    const Result<QImage> first = automaticMask(sheet, {}, progress);
    QVERIFY(first);
    const std::vector<QImage> leaves = separateLeaves(sheet, *first);
    QCOMPARE(leaves.size(), size_t(2));
    QVERIFY(whiteOf(leaves[0]) >= whiteOf(leaves[1]));
    QVERIFY(test::overlap(leaves[0], leaves[1]) == 0);
    QCOMPARE(separateLeaves(rgba(one.photo), one.mask).size(), size_t(1));
  }

  void aBareMaskIsItsOwn() {
    const QImage mask = test::ellipseMask({200, 160}, {30, 30, 120, 90});
    QVERIFY(test::overlap(bareMask(rgba(mask)), mask) > 0.999);
    QVERIFY(test::overlap(bareMask(rgba(invertedMask(mask))), mask) > 0.999);
    QVERIFY(bareMask(rgba(paintLeafPhoto({}, 3, 200).photo)).isNull());
    Progress progress;
    const Result<QImage> found = automaticMask(rgba(mask), {}, progress);
    QVERIFY(found);
    QVERIFY(test::overlap(*found, mask) > 0.999);
  }

  void holesAreKeptOnlyWhenAskedFor() {
    QImage image(120, 90, QImage::Format_RGBA8888);
    image.fill(Qt::transparent);
    QPainter painter(&image);
    painter.fillRect(30, 20, 50, 40, QColor(30, 90, 30));
    painter.setCompositionMode(QPainter::CompositionMode_Clear);
    painter.fillRect(45, 30, 10, 10, Qt::black);
    painter.end();
    Progress progress;
    QCOMPARE(int(automaticMask(image, {true}, progress)->constScanLine(35)[50]), 0);
    QCOMPARE(int(automaticMask(image, {false}, progress)->constScanLine(35)[50]), 255);
  }

  void sharesOfMissingAreaAgreeWithLeafByte() {
    if (test::sharedData("photos").isEmpty()) QSKIP("shared/data/photos is absent");
    // Total and missing square centimetres, as shared/data/INDEX.md gives them.
    const std::tuple<const char*, double, double> references[] = {
        {"oak_red_holes", 52.046, 1.318},  {"ginkgo", 28.366, 0.0},          {"nasturtium_round", 60.034, 0.002},
        {"compound_small", 25.632, 2.422}, {"dogwood_holes", 23.951, 0.992},
    };
    for (const auto& [name, total, missing] : references) {
      const QImage photo = photoOf(QString::fromLatin1(name));
      Progress progress;
      const Result<QImage> mask = automaticMask(photo, {true}, progress);
      QVERIFY(mask);
      const double filled = whiteOf(filledMask(*mask)), share = (filled - whiteOf(*mask)) / filled;
      qInfo("%s: %.4f, LeafByte %.4f", name, share, missing / total);
      QVERIFY2(std::abs(share - missing / total) <= 0.01, name);
    }
  }
};

WINDFALL_SUITE(LeafMaskEdit)
#include "leaf_mask_edit.moc"
