// The order of leaf_textures.md, 13.10, on the photographs that its figures are of.
#include <QtTest>

#include "support/quality_order.h"
#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;

class LeafQualityOrderLong : public QObject {
  Q_OBJECT
 private slots:
  void methodsRankAsTheNoteSays_data() {
    QTest::addColumn<QString>("example");
    QTest::addColumn<QString>("target");
    QTest::newRow("soybean, beech") << "soybean_blue.jpg"
                                    << "beech_scan_a.jpg";
    QTest::newRow("beech, soybean") << "beech_scan_a.jpg"
                                    << "soybean_blue.jpg";
  }
  void methodsRankAsTheNoteSays() {
    QFETCH(QString, example);
    QFETCH(QString, target);
    const std::optional<LeafStages> from = stages(example), to = stages(target);
    if (!from || !to) QSKIP("no shared photographs");
    test::QualityOrder q = test::qualityOrder(*to, *from, 4);
    for (const auto& [name, entry] : q) {
      qInfo("%-32s Q %5.1f  copy %5.2f  diversity %5.1f", name.c_str(), entry.score, entry.copyIndex, entry.diversity);
    }
    const auto above = [&](const char* better, const char* worse, double by) {
      QVERIFY2(q[better].score > q[worse].score + by, better);
    };
    above("guided", "classic with detail", 5);
    above("classic with detail", "naive: random patches, 32 px", 5);
    // The note's prototypes had 25 and 18, 28 and 23; seeds differ by 2 to 3.
    above("naive: random patches, 32 px", "thesis", -3);
    above("thesis", "naive: mean colour of regions", -3);
    above("naive: mean colour of regions", "naive: one mean colour", 2);
    above("guided", "naive: photo stretched by rows", 10);
    above("guided", "mean with veins", 30);
    QVERIFY(q["guided"].score >= 55 && q["classic with detail"].score >= 38);
    QVERIFY(q["guided"].copyIndex < 0.6 && q["guided"].diversity > 5);
    QVERIFY(q["naive: photo stretched by rows"].copyIndex >= 0.9);
  }

 private:
  static std::optional<LeafStages> stages(const QString& name) {
    const QString path = test::sharedData("photos/" + name);
    Result<SourceFile> source = readSourceFile(path);
    if (path.isEmpty() || !source) return std::nullopt;
    Leaf leaf;
    leaf.photo = std::move(*source);
    leaf.parameters.synthesis.size = 512;
    Progress progress;
    Result<LeafStages> made = computeStages(leaf, Stage::Superpixels, progress);
    return made ? std::optional<LeafStages>(std::move(*made)) : std::nullopt;
  }
};

WINDFALL_SUITE(LeafQualityOrderLong)
#include "leaf_quality_order_long.moc"
