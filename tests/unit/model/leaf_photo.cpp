#include <QtEndian>
#include <QtTest>

#include "model/leaf/stages.h"
#include "support/leaf_fixture.h"
#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;

namespace {

/// Red left half, blue right half.
QImage halves(QImage::Format format) {
  QImage image(40, 24, QImage::Format_RGB32);
  image.fill(Qt::red);
  QPainter(&image).fillRect(20, 0, 20, 24, Qt::blue);
  return image.convertToFormat(format);
}

/// The JPEG with an EXIF block that says how the camera was held.
QByteArray withOrientation(QByteArray jpeg, char orientation) {
  QByteArray exif(
      "\xff\xe1\x00\x22"
      "Exif\0\0"
      "MM\0\x2a\0\0\0\x08"
      "\0\x01"
      "\x01\x12\0\x03\0\0\0\x01\0",
      29);
  exif.append(orientation).append(QByteArray(6, '\0'));
  return jpeg.insert(2, exif);
}

}  // namespace

class LeafPhoto : public QObject {
  Q_OBJECT
 private slots:
  void turnsAsTheCameraWasHeld() {
    const Result<QImage> upright =
        readPhoto({"a.jpg", withOrientation(test::encoded(halves(QImage::Format_RGB32), "JPG"), 6)});
    QVERIFY(upright);
    // Orientation 6: to be turned clockwise by a quarter; the left half comes on top.
    QCOMPARE(upright->size(), QSize(24, 40));
    QVERIFY(upright->pixelColor(12, 5).red() > 200 && upright->pixelColor(12, 35).blue() > 200);
  }

  void sixteenBitsBecomeEight() {
    const Result<QImage> photo = readPhoto({"a.png", test::encoded(halves(QImage::Format_RGBA64), "PNG")});
    QVERIFY(photo);
    QCOMPARE(photo->format(), QImage::Format_RGBA8888);
    QCOMPARE(photo->pixelColor(5, 5), QColor(Qt::red));
  }

  void moreAfterTheEndIsHarmless() {
    for (const char* format : {"JPG", "PNG"}) {
      QVERIFY(readPhoto({"a", test::encoded(halves(QImage::Format_RGB32), format) + QByteArray("a film, or a note")}));
    }
  }

  void keepsTransparency() {
    QImage image = halves(QImage::Format_RGBA8888);
    image.setPixelColor(3, 3, QColor(10, 20, 30, 77));
    const Result<QImage> photo = readPhoto({"a.png", test::encoded(image, "PNG")});
    QVERIFY(photo);
    QCOMPARE(photo->pixelColor(3, 3), QColor(10, 20, 30, 77));
  }

  void oneClearLineForWhatIsNoPhoto_data() {
    QTest::addColumn<QByteArray>("bytes");
    const QByteArray png = test::encoded(paintLeafPhoto({}, 1, 200).photo, "PNG");
    const QByteArray jpeg = test::encoded(paintLeafPhoto({}, 1, 200).photo, "JPG");
    QByteArray changed = png;
    changed[png.size() / 2] = static_cast<char>(changed[png.size() / 2] ^ 0x40);
    QByteArray huge = png;
    qToBigEndian<quint32>(90000, huge.data() + 16);
    qToBigEndian<quint32>(90000, huge.data() + 20);
    QTest::newRow("empty") << QByteArray();
    QTest::newRow("text") << QByteArray("a leaf, green");
    QTest::newRow("cut off") << png.left(png.size() / 2);
    QTest::newRow("a JPEG cut off") << jpeg.left(jpeg.size() / 2);
    QTest::newRow("a JPEG without its end") << jpeg.chopped(2);
    QTest::newRow("a byte changed") << changed;
    QTest::newRow("only a header") << png.left(24);
    QTest::newRow("claims eight thousand megapixels") << huge;
    QTest::newRow("eight pixels") << test::encoded(QImage(4, 2, QImage::Format_RGB32), "PNG");
  }
  void oneClearLineForWhatIsNoPhoto() {
    QFETCH(QByteArray, bytes);
    const Result<QImage> photo = readPhoto({"a.png", bytes});
    QVERIFY(!photo);
    QVERIFY(photo.error().message.size() > 10 && photo.error().message.find('\n') == std::string::npos);
  }
};

WINDFALL_SUITE(LeafPhoto)
#include "leaf_photo.moc"
