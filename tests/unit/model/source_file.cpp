#include "model/source_file.h"

#include <QDir>
#include <QJsonDocument>
#include <QTemporaryDir>
#include <QTest>

#include "model/plant/import.h"
#include "support/gltf_fixture.h"
#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;

namespace {

void write(const QString& path, const QByteArray& bytes) {
  QFile file(path);
  QVERIFY(file.open(QIODevice::WriteOnly));
  file.write(bytes);
}

/// The fixture as a .gltf whose buffer and one picture are files of their own.
void writeParted(const QTemporaryDir& folder, const QString& buffer) {
  test::GltfFixture fixture;
  fixture.root["buffers"] =
      QJsonArray{QJsonObject{{"uri", buffer}, {"byteLength", static_cast<int>(fixture.buffer.size())}}};
  fixture.root["images"] = QJsonArray{QJsonObject{{"uri", "lost.png"}}};
  write(folder.filePath("plant.gltf"), QJsonDocument(fixture.root).toJson());
  QVERIFY(QDir(folder.path()).mkpath("parts"));
  write(folder.filePath("parts/a b.bin"), fixture.buffer);
}

}  // namespace

class SourceFileTest : public QObject {
  Q_OBJECT
 private slots:
  void aGltfBringsTheFilesBesideIt() {
    QTemporaryDir folder;
    writeParted(folder, "parts/a%20b.bin");
    const Result<SourceFile> source = readSourceFile(folder.filePath("plant.gltf"));
    QVERIFY(source);
    QVERIFY(folder.remove());
    Plant plant;
    plant.file = *source;
    Progress progress;
    const auto geometry = loadGeometry(plant, progress);
    QVERIFY2(geometry, geometry ? "" : geometry.error().message.c_str());
    QCOMPARE(geometry->bones.size(), std::size_t{2});
  }

  void aBufferThatIsMissingIsNamed() {
    QTemporaryDir folder;
    writeParted(folder, "other.bin");
    const Result<SourceFile> source = readSourceFile(folder.filePath("plant.gltf"));
    QVERIFY(!source);
    QCOMPARE(source.error().message, std::string("its buffer \"other.bin\" is not beside it"));
  }

  void nothingOutsideTheFolderIsRead_data() {
    QTest::addColumn<QString>("uri");
    QTest::newRow("above") << "../secret.bin";
    QTest::newRow("above by a detour") << "parts/../../secret.bin";
    QTest::newRow("absolute") << "/etc/hostname";
    QTest::newRow("elsewhere") << "file:///etc/hostname";
  }
  void nothingOutsideTheFolderIsRead() {
    QFETCH(QString, uri);
    QTemporaryDir folder;
    writeParted(folder, uri);
    const Result<SourceFile> source = readSourceFile(folder.filePath("plant.gltf"));
    QVERIFY(source);
    QVERIFY(source->bytes.contains(uri.toUtf8()) || source->bytes.contains(QString(uri).replace("/", "\\/").toUtf8()));
    Plant plant;
    plant.file = *source;
    Progress progress;
    const auto geometry = loadGeometry(plant, progress);
    QVERIFY(!geometry);
    QVERIFY(QString::fromStdString(geometry.error().message).contains("outside the file"));
  }
};

WINDFALL_SUITE(SourceFileTest)
#include "source_file.moc"
