// The margin between the pixels of a mask.
#include <QtTest>
#include <cmath>

#include "model/leaf/soft_mask.h"
#include "support/leaf_fixture.h"
#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;

namespace {

constexpr int kSide = 96, kScale = 5;
constexpr double kRadius = 34.3, kCentre = 47.7;

/// A disc of leaf on paper, each pixel as the share of it that is leaf.
QImage disc(const QColor& leaf, const QColor& paper) {
  QImage photo(kSide, kSide, QImage::Format_RGBA8888);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      int inside = 0;
      for (int k = 0; k < 64; ++k) {
        inside += std::hypot(x + (k % 8 + 0.5) / 8 - kCentre, y + (k / 8 + 0.5) / 8 - kCentre) < kRadius;
      }
      const double share = inside / 64.0;
      const auto mixed = [&](int a, int b) { return static_cast<int>(std::lround(share * a + (1 - share) * b)); };
      photo.setPixelColor(x, y,
                          QColor(mixed(leaf.red(), paper.red()), mixed(leaf.green(), paper.green()),
                                 mixed(leaf.blue(), paper.blue()), mixed(leaf.alpha(), paper.alpha())));
    }
  }
  return photo;
}

QImage maskOf(const QImage& photo, bool byAlpha) {
  QImage mask(photo.size(), QImage::Format_Grayscale8);
  for (int y = 0; y < photo.height(); ++y) {
    for (int x = 0; x < photo.width(); ++x) {
      const QColor c = photo.pixelColor(x, y);
      mask.scanLine(y)[x] = (byAlpha ? c.alpha() > 127 : c.blue() < 130) ? 255 : 0;
    }
  }
  return mask;
}

/// How far the border of the enlarged mask lies off the disc's, px of the photo: the largest over all directions.
double roughness(const QImage& alpha) {
  double worst = 0;
  for (int k = 0; k < 720; ++k) {
    const double angle = k * M_PI / 360;
    double radius = 0;
    for (double r = 20 * kScale; r < 46 * kScale && radius == 0; r += 0.1) {
      const QPointF p = kScale * QPointF(kCentre, kCentre) + r * QPointF(std::cos(angle), std::sin(angle));
      if (alpha.constScanLine(static_cast<int>(p.y()))[static_cast<int>(p.x())] < 128) radius = r / kScale;
    }
    worst = std::max(worst, std::abs(radius - kRadius));
  }
  return worst;
}

}  // namespace

class LeafSoftMask : public QObject {
  Q_OBJECT
 private slots:
  void anEnlargedMarginFollowsThePhotoBetweenItsPixels_data() {
    QTest::addColumn<QImage>("photo");
    QTest::addColumn<bool>("byAlpha");
    QTest::newRow("leaf on paper") << disc({60, 110, 40}, {230, 228, 220}) << false;
    QTest::newRow("cut out") << disc({60, 110, 40, 255}, {60, 110, 40, 0}) << true;
  }
  void anEnlargedMarginFollowsThePhotoBetweenItsPixels() {
    QFETCH(QImage, photo);
    QFETCH(bool, byAlpha);
    const QImage mask = maskOf(photo, byAlpha);
    const double with = roughness(softMask(mask, photo, kScale * mask.size()));
    const double without = roughness(softMask(mask, {}, kScale * mask.size()));
    QVERIFY2(with < 0.4 && with < 0.75 * without, qPrintable(QString("%1 for %2").arg(with).arg(without)));
  }

  void whereThePhotoTellsNothingTheMaskIsKept() {
    // A cut through the leaf, drawn by hand.
    QImage photo(kSide, kSide, QImage::Format_RGBA8888);
    photo.fill(QColor(60, 110, 40));
    QImage mask(kSide, kSide, QImage::Format_Grayscale8);
    mask.fill(0);
    for (int y = 20; y < 76; ++y) std::fill_n(mask.scanLine(y) + 20, 28, static_cast<uchar>(255));
    const QImage alpha = softMask(mask, photo, kScale * mask.size());
    const uchar* row = alpha.constScanLine(48 * kScale);
    QCOMPARE(int(row[46 * kScale]), 255);
    QCOMPARE(int(row[50 * kScale]), 0);
    // A mask that is not enlarged is as it was.
    QCOMPARE(softMask(mask, photo, mask.size()), mask);
  }
};

WINDFALL_SUITE(LeafSoftMask)
#include "leaf_soft_mask.moc"
