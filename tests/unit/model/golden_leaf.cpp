// Pictures of the leaf path against references, with a tolerance. WINDFALL_UPDATE_GOLDEN=1 writes the references anew:
// look at them before they are committed.
#include <QBuffer>
#include <QtTest>
#include <algorithm>

#include "model/leaf/stages.h"
#include "model/sample/leaf_painter.h"
#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;

class GoldenLeafTest : public QObject {
  Q_OBJECT

  /// Mean difference of the channels, and the share of pixels where one differs by more than 32.
  static std::pair<double, double> difference(const QImage& a, const QImage& b) {
    double sum = 0, far = 0;
    for (int y = 0; y < a.height(); ++y) {
      for (int x = 0; x < a.width(); ++x) {
        const QRgb p = a.pixel(x, y), q = b.pixel(x, y);
        const int apart[] = {std::abs(qRed(p) - qRed(q)), std::abs(qGreen(p) - qGreen(q)),
                             std::abs(qBlue(p) - qBlue(q)), std::abs(qAlpha(p) - qAlpha(q))};
        for (const int d : apart) sum += d / 4.0;
        far += *std::max_element(std::begin(apart), std::end(apart)) > 32;
      }
    }
    const double pixels = a.width() * a.height();
    return {sum / pixels, far / pixels};
  }

  static void compare(const QImage& picture, const QString& name) {
    const QString path = QStringLiteral(WINDFALL_SOURCE_DIR "/tests/golden/") + name;
    const QImage actual = picture.convertToFormat(QImage::Format_ARGB32);
    if (qEnvironmentVariableIsSet("WINDFALL_UPDATE_GOLDEN")) QVERIFY(actual.save(path));
    const QImage expected = QImage(path).convertToFormat(QImage::Format_ARGB32);
    QVERIFY2(!expected.isNull(), qPrintable("there is no reference " + path));
    QCOMPARE(actual.size(), expected.size());
    const auto [mean, far] = difference(actual, expected);
    if (mean < 1.5 && far < 0.01) return;
    actual.save(test::outputFolder() + "/actual_" + name);
    expected.save(test::outputFolder() + "/expected_" + name);
    QFAIL(qPrintable(
        QStringLiteral("%1: mean difference %2, %3 %% of the pixels far off").arg(name).arg(mean).arg(100 * far)));
  }

 private slots:
  void leafPathLooksAsItDid() {
    Leaf leaf;
    const PaintedPhoto painted = paintLeafPhoto({LeafShape::Oak, 0.4, 0.4}, 7, 160);
    compare(painted.photo, QStringLiteral("oak_photo.png"));
    QBuffer buffer(&leaf.photo.bytes);
    buffer.open(QIODevice::WriteOnly);
    painted.photo.save(&buffer, "PNG");
    leaf.parameters.synthesis.size = 160;
    leaf.parameters.synthesis.superpixels = 120;
    Progress progress;
    const Result<LeafStages> stages = computeStages(leaf, Stage::Superpixels, progress);
    QVERIFY2(stages, stages ? "" : stages.error().message.c_str());
    compare(stagePicture(*stages, Stage::Mask), QStringLiteral("oak_mask.png"));
    compare(stagePicture(*stages, Stage::Contour), QStringLiteral("oak_contour.png"));
    compare(stagePicture(*stages, Stage::Veins), QStringLiteral("oak_veins.png"));
    compare(stagePicture(*stages, Stage::Distance), QStringLiteral("oak_distance.png"));
    compare(stagePicture(*stages, Stage::Regions), QStringLiteral("oak_regions.png"));
    const Result<QImage> variant = synthesize(*stages, *stages, leaf.parameters.synthesis, 3, progress);
    QVERIFY(variant);
    compare(*variant, QStringLiteral("oak_variant.png"));
  }
};

WINDFALL_SUITE(GoldenLeafTest)
#include "golden_leaf.moc"
