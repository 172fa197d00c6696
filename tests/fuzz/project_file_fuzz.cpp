// Mutated project files, by fixed seeds: never a crash, one clear line or a project that can be saved again.
#include <QTemporaryDir>
#include <QtTest>

#include "model/document/archive.h"
#include "model/document/project_file.h"
#include "model/document/project_json.h"
#include "support/raw_zip.h"
#include "support/rich_project.h"
#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;

namespace {

class Dice {
 public:
  explicit Dice(quint64 seed) : state_(seed * 0x9E3779B97F4A7C15ULL + 1) {}
  qsizetype below(qsizetype count) {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<qsizetype>((state_ >> 33) % static_cast<quint64>(count));
  }

 private:
  quint64 state_;
};

void flipBits(QByteArray& bytes, Dice& dice) {
  for (qsizetype flips = 1 + dice.below(8); flips > 0 && !bytes.isEmpty(); --flips) {
    char& byte = bytes[dice.below(bytes.size())];
    byte = static_cast<char>(byte ^ (1 << dice.below(8)));
  }
}

/// Puts an extreme number over a field of a header.
void lieInHeader(QByteArray& file, Dice& dice) {
  static const QList<QByteArray> signatures{"PK\x01\x02", "PK\x03\x04", "PK\x05\x06"};
  QList<qsizetype> places;
  const QByteArray& signature = signatures[dice.below(3)];
  for (qsizetype at = file.indexOf(signature); at >= 0; at = file.indexOf(signature, at + 1)) places << at;
  const qsizetype place = places[dice.below(places.size())] + 4 + dice.below(26);
  const QByteArray values[] = {QByteArray(4, '\0'), QByteArray(4, '\xff'), QByteArray("\xff\xff\xff\x7f", 4),
                               QByteArray("\1\0\0\0", 4), QByteArray("\0\0\1\0", 4)};
  const qsizetype length = dice.below(2) ? 2 : 4;
  if (place + length <= file.size()) file.replace(place, length, values[dice.below(5)].left(length));
}

/// Puts a token where another stood.
void mutateJson(QByteArray& json, Dice& dice) {
  static const QList<QByteArray> tokens{"-1",
                                        "0",
                                        "1e999",
                                        "-1e308",
                                        "1e-320",
                                        "null",
                                        "true",
                                        "\"\"",
                                        "\"../x\"",
                                        "[]",
                                        "{}",
                                        "[[]]",
                                        "9007199254740993",
                                        "4294967296",
                                        "0.5",
                                        "\"leaves/3/mask.png\"",
                                        "\"project.json\"",
                                        "{\"a\": {\"b\": []}}",
                                        "3",
                                        "7",
                                        "100000000000000000000"};
  for (qsizetype times = 1 + dice.below(3); times > 0; --times) {
    const qsizetype colon = json.indexOf(": ", dice.below(json.size()));
    if (colon < 0) continue;
    qsizetype end = colon + 2;
    while (end < json.size() && json[end] != ',' && json[end] != '\n') ++end;
    // An opening bracket takes the rest of its list or object out of step: that is a case, too.
    json.replace(colon + 2, end - colon - 2, tokens[dice.below(tokens.size())]);
  }
}

}  // namespace

class ProjectFileFuzzTest : public QObject {
  Q_OBJECT
 private slots:
  void initTestCase();
  void bitFlips() {
    run(200, [this](Dice& dice) { return changed(flipBits, dice); });
  }
  void truncations() {
    run(60, [this](Dice& dice) { return whole_.left(dice.below(whole_.size())); });
  }
  void headerLies() {
    run(150, [this](Dice& dice) { return changed(lieInHeader, dice); });
  }
  void otherValues() {
    run(400, [this](Dice& dice) { return within("project.json", mutateJson, dice); });
  }
  void brokenText() {
    run(100, [this](Dice& dice) { return within("project.json", flipBits, dice); });
  }
  void brokenPictures() {
    run(100, [this](Dice& dice) {
      return within(dice.below(2) ? "leaves/3/mask.png" : "leaves/3/variants/0001.png", flipBits, dice);
    });
  }
  void somethingWasRefusedAndSomethingAccepted() {
    QVERIFY(refused_ > 300);
    QVERIFY(accepted_ > 20);
  }

 private:
  using Mutate = void (*)(QByteArray&, Dice&);

  QByteArray changed(Mutate mutate, Dice& dice) const {
    QByteArray file = whole_;
    mutate(file, dice);
    return file;
  }
  /// One entry is another, in a zip that is sound: so the mutation reaches the readers behind the archive.
  QByteArray within(const QByteArray& name, Mutate mutate, Dice& dice) const {
    QList<test::RawEntry> entries = entries_;
    for (test::RawEntry& entry : entries) {
      if (entry.name == name) mutate(entry.content, dice);
    }
    return test::rawZip(entries);
  }

  static bool put(const QString& path, const QByteArray& bytes) {
    // A new file each time: overwriting one makes some file systems flush it to the disk.
    QFile::remove(path);
    QFile file(path);
    return file.open(QIODevice::WriteOnly) && file.write(bytes) == bytes.size();
  }

  void run(int times, const std::function<QByteArray(Dice&)>& make) {
    const QString path = folder_.filePath("mutant.windfall"), again = folder_.filePath("again.windfall");
    for (int i = 0; i < times; ++i) {
      Dice dice(static_cast<quint64>(i) + 1);
      QVERIFY(put(path, make(dice)));
      Progress progress;
      const Result<Project> read = readProject(path, progress);
      if (!read) {
        ++refused_;
        const QString message = QString::fromStdString(read.error().message);
        QVERIFY2(!message.isEmpty() && !message.contains('\n') && message.size() < 600, qPrintable(message));
        continue;
      }
      ++accepted_;
      // Without the syncs of writeProject, which would take most of the time.
      const Result<std::vector<ArchiveEntry>> entries = toEntries(*read);
      QVERIFY2(entries, entries ? "" : entries.error().message.c_str());
      QVERIFY(put(again, *packArchive(*entries, progress)));
      const Result<Project> back = readProject(again, progress);
      QVERIFY2(back, back ? "" : back.error().message.c_str());
      QVERIFY(*back == *read);
    }
  }

  QTemporaryDir folder_;
  QByteArray whole_;
  QList<test::RawEntry> entries_;
  int refused_ = 0, accepted_ = 0;
};

void ProjectFileFuzzTest::initTestCase() {
  const QString path = folder_.filePath("whole.windfall");
  Progress progress;
  QVERIFY(writeProject(test::richProject(), path, progress));
  QFile file(path);
  QVERIFY(file.open(QIODevice::ReadOnly));
  whole_ = file.readAll();
  Result<ArchiveReader> archive = ArchiveReader::open(path);
  QVERIFY(archive);
  for (const QString& name : archive->names()) {
    entries_ << test::RawEntry{name.toUtf8(), *archive->read(name, 1 << 20, progress)};
  }
}

WINDFALL_SUITE(ProjectFileFuzzTest)
#include "project_file_fuzz.moc"
