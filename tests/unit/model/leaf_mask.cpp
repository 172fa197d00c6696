#include "model/leaf/mask.h"

#include <QDir>
#include <QtTest>
#include <cmath>

#include "kernels/random.h"
#include "model/leaf/stages.h"
#include "support/leaf_fixture.h"
#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;

namespace {

QImage rgba(const QImage& image) { return image.convertToFormat(QImage::Format_RGBA8888); }

/// Light that falls off from a corner to less than half.
QImage unevenlyLit(QImage photo) {
  photo = rgba(photo);
  for (int y = 0; y < photo.height(); ++y) {
    for (int x = 0; x < photo.width(); ++x) {
      const double light = 1 - 0.55 * (double(x) / photo.width() + double(y) / photo.height()) / 2;
      for (int c = 0; c < 3; ++c) {
        uchar& value = photo.scanLine(y)[4 * x + c];
        value = static_cast<uchar>(value * light);
      }
    }
  }
  return photo;
}

}  // namespace

class LeafMask : public QObject {
  Q_OBJECT
 private slots:
  void findsPaintedLeaves_data() {
    QTest::addColumn<int>("shape");
    QTest::addColumn<double>("autumn");
    QTest::addColumn<bool>("uneven");
    for (int shape = 0; shape < 4; ++shape) {
      for (const double autumn : {0.0, 0.5, 1.0}) {
        QTest::addRow("shape %d, autumn %.1f", shape, autumn) << shape << autumn << (shape % 2 == 1);
      }
    }
  }
  void findsPaintedLeaves() {
    QFETCH(int, shape);
    QFETCH(double, autumn);
    QFETCH(bool, uneven);
    const PaintedPhoto painted = paintLeafPhoto({static_cast<LeafShape>(shape), autumn, 0.7}, 21, 420);
    const QImage photo = uneven ? unevenlyLit(painted.photo) : rgba(painted.photo);
    Progress progress;
    const Result<QImage> mask = automaticMask(photo, {}, progress);
    QVERIFY2(mask, mask ? "" : mask.error().message.c_str());
    const double iou = test::overlap(*mask, painted.mask);
    QVERIFY2(iou > 0.93, qPrintable(QString::number(iou)));
  }

  void aRulerLargerThanTheLeafIsNotTheLeaf() {
    const PaintedPhoto painted = paintLeafPhoto({}, 5, 260);
    const QColor paper = painted.photo.pixelColor(4, painted.photo.height() / 2);
    QImage photo(700, 640, QImage::Format_RGBA8888), wanted(700, 640, QImage::Format_Grayscale8);
    photo.fill(paper);
    wanted.fill(0);
    QPainter(&photo).drawImage(200, 180, painted.photo);
    QPainter(&wanted).drawImage(200, 180, painted.mask);
    Progress progress;
    for (const bool standing : {false, true}) {
      QImage both = photo;
      QPainter painter(&both);
      if (standing) painter.setTransform(QTransform(0, 1, 1, 0, 0, 0));
      painter.fillRect(16, 570, 600, 50, QColor(250, 210, 60));
      for (int x = 24; x < 600; x += 9) painter.fillRect(x, 570, 1, x % 45 ? 14 : 26, Qt::black);
      painter.end();
      const Result<QImage> mask = automaticMask(both, {}, progress);
      QVERIFY(mask);
      QVERIFY2(test::overlap(*mask, wanted) > 0.93, qPrintable(QString::number(test::overlap(*mask, wanted))));
    }
    // Alone a bar is what was photographed: a blade of grass may be as straight.
    QImage bar(400, 300, QImage::Format_RGBA8888);
    bar.fill(paper);
    QPainter(&bar).fillRect(60, 130, 280, 30, QColor(66, 120, 44));
    const Result<QImage> mask = automaticMask(bar, {}, progress);
    QVERIFY(mask);
    QCOMPARE(int(mask->constScanLine(145)[200]), 255);
  }

  void aPenStrokeThatRunsIntoTheLeafIsNone() {
    for (const QColor& ink : {QColor(30, 36, 90), QColor(14, 14, 16)}) {
      const PaintedPhoto painted = paintLeafPhoto({}, 11, 420);
      QImage photo = painted.photo.convertToFormat(QImage::Format_RGBA8888);
      const QPointF middle = 0.5 * (painted.root + painted.tip);
      // Under the leaf, from one side of the paper to the other.
      QPainter painter(&photo);
      painter.setPen(QPen(ink, 5));
      painter.drawLine(QPointF(12, middle.y() + 20), QPointF(photo.width() - 12, middle.y() - 30));
      painter.end();
      for (int y = 0; y < photo.height(); ++y) {
        for (int x = 0; x < photo.width(); ++x) {
          if (painted.mask.constScanLine(y)[x] > 127) photo.setPixelColor(x, y, painted.photo.pixelColor(x, y));
        }
      }
      Progress progress;
      const Result<QImage> mask = automaticMask(photo, {}, progress);
      QVERIFY(mask);
      int beyond = 0;
      for (int y = 0; y < photo.height(); ++y) {
        for (const int x : {20, photo.width() - 20}) beyond += mask->constScanLine(y)[x] > 127;
      }
      QCOMPARE(beyond, 0);
      const double iou = test::overlap(*mask, painted.mask);
      QVERIFY2(iou > 0.95, qPrintable(QString::number(iou)));
    }
  }

  void holesStayHoles() {
    const PaintedPhoto painted = paintLeafPhoto({}, 5, 420);
    QImage photo = rgba(painted.photo);
    const QPoint middle = (0.5 * (painted.root + painted.tip)).toPoint() + QPoint(35, 0);
    const QColor paper = photo.pixelColor(8, middle.y());
    QPainter painter(&photo);
    painter.setBrush(paper);
    painter.setPen(Qt::NoPen);
    painter.drawEllipse(middle, 14, 14);
    painter.end();
    QVERIFY(painted.mask.pixelColor(middle).red() > 127);
    Progress progress;
    const Result<QImage> mask = automaticMask(photo, {}, progress);
    QVERIFY(mask);
    QCOMPARE(mask->pixelColor(middle).red(), 0);
  }

  void transparencyIsTheMask() {
    QImage image(120, 90, QImage::Format_RGBA8888);
    image.fill(Qt::transparent);
    QPainter(&image).fillRect(30, 20, 50, 40, QColor(30, 90, 30));
    Progress progress;
    const Result<QImage> mask = automaticMask(image, {}, progress);
    QVERIFY(mask);
    QCOMPARE(mask->pixelColor(31, 21).red(), 255);
    QCOMPARE(mask->pixelColor(29, 21).red(), 0);
  }

  void saysWhereNoLeafIs_data() {
    QTest::addColumn<QImage>("image");
    QImage flat(300, 200, QImage::Format_RGBA8888);
    flat.fill(QColor(200, 196, 190));
    QImage noise = flat, slope = flat;
    for (int y = 0; y < 200; ++y) {
      for (int x = 0; x < 300; ++x) {
        const auto at = static_cast<std::uint32_t>(y * 300 + x);
        noise.setPixelColor(x, y, QColor(hash(1, at) & 255, hash(2, at) & 255, hash(3, at) & 255));
        slope.setPixelColor(x, y, QColor(60 + x / 2, 70 + x / 2, 90 + x / 3));
      }
    }
    QImage clear = flat;
    clear.fill(Qt::transparent);
    QTest::newRow("flat") << flat;
    QTest::newRow("noise") << noise;
    QTest::newRow("slope") << slope;
    QTest::newRow("transparent") << clear;
  }
  void saysWhereNoLeafIs() {
    QFETCH(QImage, image);
    Progress progress;
    const Result<QImage> mask = automaticMask(image, {}, progress);
    QVERIFY(!mask);
    QVERIFY(QString::fromStdString(mask.error().message).startsWith("no leaf found"));
  }

  void agreesWithTheReferenceMasks() {
    const QString folder = test::sharedData("masks");
    if (folder.isEmpty()) QSKIP("shared/data/masks is absent");
    for (const QFileInfo& file : QDir(folder).entryInfoList({"*.png"})) {
      const QFileInfoList photos = QDir(test::sharedData("photos")).entryInfoList({file.baseName() + ".*"});
      QCOMPARE(photos.size(), 1);
      const Result<SourceFile> source = readSourceFile(photos[0].filePath());
      QVERIFY(source);
      const Result<QImage> photo = readPhoto(*source);
      QVERIFY(photo);
      Progress progress;
      const Result<QImage> mask = automaticMask(*photo, {}, progress);
      QVERIFY2(mask, qPrintable(file.baseName()));
      const double iou = test::overlap(*mask, QImage(file.filePath()).convertToFormat(QImage::Format_Grayscale8));
      qInfo("%s %.4f", qPrintable(file.baseName()), iou);
      QVERIFY2(iou >= 0.95, qPrintable(file.baseName() + QString(" %1").arg(iou)));
    }
  }
};

WINDFALL_SUITE(LeafMask)
#include "leaf_mask.moc"
