// windfall leaf and windfall atlas, as typed by a user.
#include <QDir>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTemporaryDir>
#include <QtTest>
#include <cmath>

#include "model/leaf/vein.h"
#include "support/leaf_fixture.h"
#include "support/program_fixture.h"
#include "support/suite.h"

using namespace windfall;

namespace {

test::ProgramRun windfallRun(const QStringList& arguments, bool interrupt = false) {
  return test::runProgram(QStringLiteral(WINDFALL_PROGRAM), arguments, interrupt);
}

QByteArray bytesOf(const QString& path) {
  QFile file(path);
  return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

}  // namespace

class LeafCliTest : public QObject {
  Q_OBJECT
 private slots:
  void initTestCase() {
    const model::PaintedPhoto painted = model::paintLeafPhoto({}, 3, 260);
    QVERIFY(painted.photo.save(at("leaf.png")));
    QVERIFY(painted.mask.save(at("mask.png")));
    QImage(30, 30, QImage::Format_Grayscale8).save(at("small.png"));
    QImage flat(100, 100, QImage::Format_RGB32);
    flat.fill(Qt::gray);
    QVERIFY(flat.save(at("flat.png")));
    QVERIFY(QImage(1, 1, QImage::Format_RGB32).save(at("one.png")));
    QImage huge(20000, 20000, QImage::Format_Mono);
    huge.fill(0);
    QVERIFY(huge.save(at("huge.png")));
    QImage lines(painted.photo.size(), QImage::Format_Grayscale8);
    lines.fill(0);
    QVERIFY(lines.save(at("no_lines.png")));
    QPainter painter(&lines);
    painter.setPen(QPen(Qt::white, 4));
    painter.drawLine(painted.root, painted.tip);
    painter.drawLine(0.5 * (painted.root + painted.tip), 0.5 * (painted.root + painted.tip) + QPointF(40, -30));
    painter.end();
    QVERIFY(lines.save(at("lines.png")));
    QFile garbage(at("garbage.jpg"));
    QVERIFY(garbage.open(QIODevice::WriteOnly));
    garbage.write("no picture");
    QFile broken(at("broken.json"));
    QVERIFY(broken.open(QIODevice::WriteOnly));
    broken.write("{");
  }

  void writesEveryStage() {
    const QStringList arguments{"leaf", at("leaf.png"), "-o", at("out"), "--variants", "2", "--size", "200"};
    const test::ProgramRun run = windfallRun(arguments);
    QCOMPARE(run.status, 0);
    for (const char* name :
         {"mask.png", "veins.png", "distance.png", "regions.png", "superpixels_1.png", "variant_000.png",
          "variant_001.png", "look_contour.jpg", "variant_000_normal.png", "variant_000_height.png",
          "variant_001_roughness.png", "variant_001_translucency.png", "variant_000_occlusion.png"}) {
      QVERIFY2(!QImage(at("out/") + name).isNull(), name);
    }
    QCOMPARE(QImage(at("out/mask.png")).size(), QImage(at("leaf.png")).size());
    const QJsonObject contour = QJsonDocument::fromJson(bytesOf(at("out/contour.json"))).object();
    QVERIFY(contour["points"].toArray().size() > 8);
    const QJsonObject veins = QJsonDocument::fromJson(bytesOf(at("out/veins.json"))).object();
    QVERIFY(veins["veins"].toArray().size() > 5);
    const QJsonObject timings = QJsonDocument::fromJson(bytesOf(at("out/timings.json"))).object();
    QVERIFY(timings["stages"].toObject().contains("mask"));
    QCOMPARE(timings["variants"].toArray().size(), 2);
    for (const char* stage : {"seconds", "maps", "mesh"}) {
      QVERIFY2(timings["variants"].toArray()[0].toObject()[QLatin1String(stage)].toDouble() > 0, stage);
    }
    const QJsonObject mesh = QJsonDocument::fromJson(bytesOf(at("out/variant_000_mesh.json"))).object();
    QCOMPARE(mesh["levels"].toArray().size(), 4);
    QCOMPARE(QImage(at("out/variant_000_normal.png")).size(), QImage(at("out/variant_000.png")).size());
    // The same again gives the same textures; fewer leave none of the old behind; nothing unfinished stays.
    const QByteArray first = bytesOf(at("out/variant_000.png"));
    QCOMPARE(windfallRun({"leaf", at("leaf.png"), "-o", at("out"), "--variants", "1", "--size", "200"}).status, 0);
    QCOMPARE(bytesOf(at("out/variant_000.png")), first);
    QVERIFY(!QFile::exists(at("out/variant_001.png")));
    QVERIFY(!QFile::exists(at("out/variant_001_normal.png")));
    QVERIFY(QDir(folder_.path()).entryList({".windfall*"}, QDir::AllEntries | QDir::Hidden).isEmpty());
  }

  void marksThatAreGivenAreTaken() {
    const test::ProgramRun run =
        windfallRun({"leaf", at("leaf.png"), "-o", at("given"), "--mask", at("mask.png"), "--root", "130,200",
                     "--variants", "0", "--size", "128", "--mode", "classic"});
    QCOMPARE(run.status, 0);
    QVERIFY(test::overlap(QImage(at("given/mask.png")).convertToFormat(QImage::Format_Grayscale8),
                          QImage(at("mask.png")).convertToFormat(QImage::Format_Grayscale8)) > 0.999);
    const QJsonArray root = QJsonDocument::fromJson(bytesOf(at("given/contour.json"))).object()["root"].toArray();
    QCOMPARE(root[0].toDouble(), 130.0);
  }

  void presetsAndAgeChangeTheTextures() {
    const QStringList base{"leaf", at("leaf.png"), "--variants", "1", "--size", "160"};
    QCOMPARE(windfallRun(base + QStringList{"-o", at("fresh"), "--preset", "Birch"}).status, 0);
    QCOMPARE(windfallRun(base + QStringList{"-o", at("old"), "--preset", "Birch", "--age", "0.95"}).status, 0);
    const QImage fresh(at("fresh/variant_000.png")), old(at("old/variant_000.png"));
    QCOMPARE(old.size(), fresh.size());
    const QPoint middle(fresh.width() / 2, fresh.height() / 2);
    QVERIFY(qAlpha(fresh.pixel(middle)) == 255 && fresh.pixel(middle) != old.pixel(middle));
    QVERIFY(qRed(old.pixel(middle)) > qGreen(old.pixel(middle)));
  }

  void veinsDrawnElsewhereAreTaken() {
    QCOMPARE(windfallRun({"leaf", at("leaf.png"), "-o", at("drawn"), "--veins", at("lines.png"), "--ruler",
                          "0,0,100,0,0.05", "--variants", "0", "--size", "128"})
                 .status,
             0);
    const QJsonArray veins = QJsonDocument::fromJson(bytesOf(at("drawn/veins.json"))).object()["veins"].toArray();
    QCOMPARE(veins.size(), 2);
    QCOMPARE(veins[1].toObject()["order"].toInt(), 2);
    const QJsonObject contour = QJsonDocument::fromJson(bytesOf(at("drawn/contour.json"))).object();
    const QJsonArray root = contour["root"].toArray(), tip = contour["tip"].toArray();
    const double pixels = std::hypot(root[0].toDouble() - tip[0].toDouble(), root[1].toDouble() - tip[1].toDouble());
    QVERIFY(std::abs(contour["bladeLength"].toDouble() - 0.05 * pixels / 100) < 1e-4);
  }

  void aBareMaskTakesItsColoursFromAnExample() {
    QCOMPARE(windfallRun({"leaf", at("mask.png"), "-o", at("bare"), "--example", at("leaf.png"), "--variants", "1",
                          "--size", "128", "--vary"})
                 .status,
             0);
    QVERIFY(!QImage(at("bare/variant_000.png")).isNull());
  }

  void packsAFolderOfVariants() {
    QCOMPARE(windfallRun({"leaf", at("leaf.png"), "-o", at("pack"), "--variants", "2", "--size", "128"}).status, 0);
    QCOMPARE(windfallRun({"atlas", at("pack"), "-o", at("atlas"), "--size", "256", "--padding", "8"}).status, 0);
    QCOMPARE(QImage(at("atlas/atlas.png")).size(), QSize(256, 256));
    const QJsonObject json = QJsonDocument::fromJson(bytesOf(at("atlas/atlas.json"))).object();
    QCOMPARE(json["leaves"].toArray().size(), 2);
    for (const char* map : {"normal", "height", "roughness", "translucency", "occlusion"}) {
      QCOMPARE(QImage(at(QString("atlas/atlas_%1.png").arg(map))).size(), QSize(256, 256));
    }
    // Another packing leaves none of the first's files behind.
    QCOMPARE(windfallRun({"atlas", at("pack"), "-o", at("atlas"), "--size", "256", "--packer", "gltf", "--mips", "2",
                          "--mip-files"})
                 .status,
             0);
    QVERIFY(!QFile::exists(at("atlas/atlas_roughness.png")));
    QCOMPARE(QImage(at("atlas/atlas_orm.png")).size(), QSize(256, 256));
    QCOMPARE(QImage(at("atlas/atlas_mip2.png")).size(), QSize(64, 64));
    QVERIFY(json["leaves"].toArray()[0].toObject()["pivot"].toArray()[1].toDouble() > 0.85);
  }

  void badFilesAndUsageHaveTheirStatus_data() {
    QTest::addColumn<QStringList>("arguments");
    QTest::addColumn<int>("status");
    const auto row = [&](const char* name, int status, const QStringList& arguments) {
      QTest::newRow(name) << arguments << status;
    };
    row("no photo", 1, {"leaf", at("none.jpg"), "-o", at("bad")});
    row("not a picture", 1, {"leaf", at("garbage.jpg"), "-o", at("bad")});
    row("one pixel", 1, {"leaf", at("one.png"), "-o", at("bad")});
    row("veins of another size", 1, {"leaf", at("leaf.png"), "-o", at("bad"), "--veins", at("small.png")});
    row("veins without a line", 1, {"leaf", at("leaf.png"), "-o", at("bad"), "--veins", at("no_lines.png")});
    row("markers without a spot", 1, {"leaf", at("leaf.png"), "-o", at("bad"), "--markers", at("no_lines.png")});
    row("huge", 1, {"leaf", at("huge.png"), "-o", at("bad")});
    row("folder cannot be made", 1, {"leaf", at("leaf.png"), "-o", "/dev/full/bad", "--variants", "0", "--size", "64"});
    row("ruler of one place", 2, {"leaf", at("leaf.png"), "-o", at("bad"), "--ruler", "1,1,1,1,0.1"});
    row("no leaf in it", 1, {"leaf", at("flat.png"), "-o", at("bad")});
    row("mask of another size", 1, {"leaf", at("leaf.png"), "-o", at("bad"), "--mask", at("small.png")});
    row("root outside", 1, {"leaf", at("leaf.png"), "-o", at("bad"), "--root", "4000,3"});
    row("folder is a file", 1, {"leaf", at("leaf.png"), "-o", at("garbage.jpg"), "--variants", "0", "--size", "64"});
    row("root of one number", 2, {"leaf", at("leaf.png"), "-o", at("bad"), "--root", "4000"});
    row("no folder", 2, {"leaf", at("leaf.png")});
    row("size too small", 2, {"leaf", at("leaf.png"), "-o", at("bad"), "--size", "3"});
    row("negative variants", 2, {"leaf", at("leaf.png"), "-o", at("bad"), "--variants", "-1"});
    row("no such preset", 1, {"leaf", at("leaf.png"), "-o", at("bad"), "--preset", "Cactus"});
    row("preset is no preset", 1, {"leaf", at("leaf.png"), "-o", at("bad"), "--preset", at("broken.json")});
    row("age beyond", 2, {"leaf", at("leaf.png"), "-o", at("bad"), "--age", "2"});
    row("unknown packer", 2, {"atlas", folder_.path(), "-o", at("bad"), "--packer", "doom"});
    row("no folder can be made there", 1,
        {"leaf", at("leaf.png"), "-o", "/dev/null/x", "--variants", "0", "--size", "64"});
    row("atlas where no folder can be", 1, {"atlas", at("pack"), "-o", "/dev/null/x", "--size", "256"});
    row("unknown mode", 2, {"leaf", at("leaf.png"), "-o", at("bad"), "--mode", "magic"});
    row("atlas of nothing", 1, {"atlas", folder_.path(), "-o", at("bad")});
    row("atlas of no power of two", 2, {"atlas", folder_.path(), "-o", at("bad"), "--size", "1000"});
  }
  void badFilesAndUsageHaveTheirStatus() {
    QFETCH(QStringList, arguments);
    QFETCH(int, status);
    const test::ProgramRun run = windfallRun(arguments);
    QCOMPARE(run.status, status);
    QVERIFY(run.error.startsWith("windfall: "));
    QCOMPARE(run.error.trimmed().count('\n'), 0);
    QVERIFY(!QFile::exists(at("bad")));
  }

  void interruptedRunsWriteNothing() {
    const test::ProgramRun run =
        windfallRun({"leaf", at("leaf.png"), "-o", at("cut"), "--size", "1024", "--variants", "900"}, true);
    QCOMPARE(run.status, 130);
    QVERIFY(!QFile::exists(at("cut")));
  }

 private:
  QString at(const QString& name) const { return folder_.filePath(name); }
  QTemporaryDir folder_;
};

WINDFALL_SUITE(LeafCliTest)
#include "leaf_cli.moc"
