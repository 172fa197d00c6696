// Reading and writing .prim streams.
#include "model/plant/prim_format.h"

#include <QElapsedTimer>
#include <QtTest>
#include <cstring>

#include "support/skeleton_data.h"
#include "support/suite.h"

using namespace windfall;
using model::PrimFile;
using model::SkeletonGraph;

namespace {

QByteArray bytesOf(const QString& name) {
  QFile file(test::sharedData("prim/" + name));
  if (file.fileName().isEmpty() || !file.open(QIODevice::ReadOnly)) return {};
  return file.readAll();
}

double stemLength(const SkeletonGraph& graph, bool roots = false) {
  double sum = 0;
  for (const model::Segment& s : graph.segments) {
    if ((s.kind == model::SegmentKind::Root) == roots) sum += static_cast<double>(lengthOf(s));
  }
  return sum;
}

float widestGap(const SkeletonGraph& graph) {
  float gap = 0;
  for (const model::Segment& s : graph.segments) {
    if (s.parent >= 0) gap = std::max(gap, glm::length(s.a - graph.segments[static_cast<std::size_t>(s.parent)].b));
  }
  return gap;
}

/// What differs between two graphs, empty for none; places within 1e-6 m, state if `state`.
QString difference(const SkeletonGraph& a, const SkeletonGraph& b, bool state) {
  if (a.plants != b.plants || a.segments.size() != b.segments.size() || a.leaves.size() != b.leaves.size() ||
      a.buds.size() != b.buds.size()) {
    return "counts";
  }
  const auto far = [](vec3 p, vec3 q) { return glm::length(p - q) > 1e-6f; };
  for (std::size_t i = 0; i < a.segments.size(); ++i) {
    const model::Segment &s = a.segments[i], &t = b.segments[i];
    if (s.parent != t.parent || s.kind != t.kind || s.plant != t.plant || s.organ != t.organ || far(s.a, t.a) ||
        far(s.b, t.b) || s.ra != t.ra || std::abs(lengthOf(s) - lengthOf(t)) > 1e-6f ||
        std::abs(s.attach - t.attach) > 1e-6f || (state && !(s.state == t.state))) {
      return QStringLiteral("segment %1").arg(i);
    }
  }
  for (std::size_t i = 0; i < a.leaves.size(); ++i) {
    const model::LeafOrgan &s = a.leaves[i], &t = b.leaves[i];
    if (s.segment != t.segment || s.organ != t.organ || far(s.base, t.base) || far(s.tip, t.tip) ||
        glm::length(s.normal - t.normal) > 1e-4f || std::abs(s.width - t.width) > 1e-6f ||
        (state && !(s.state == t.state))) {
      return QStringLiteral("leaf %1").arg(i);
    }
  }
  for (std::size_t i = 0; i < a.buds.size(); ++i) {
    const model::BudOrgan &s = a.buds[i], &t = b.buds[i];
    if (s.segment != t.segment || s.organ != t.organ || far(s.centre, t.centre) || s.radius != t.radius) {
      return QStringLiteral("bud %1").arg(i);
    }
  }
  return {};
}

/// Version 6 without its roots.
SkeletonGraph aboveGround(SkeletonGraph graph) {
  std::erase_if(graph.segments, [](const model::Segment& s) { return s.kind == model::SegmentKind::Root; });
  return graph;
}

void put(QByteArray& bytes, std::uint32_t value) { bytes.append(reinterpret_cast<const char*>(&value), 4); }

/// Version 4 with stems of 1 m above each other; `parents` of each.
QByteArray column(const std::vector<std::int32_t>& parents, float length = 1) {
  QByteArray bytes("\x04", 1);
  put(bytes, 1);
  put(bytes, static_cast<std::uint32_t>(parents.size()));
  for (std::size_t i = 0; i < parents.size(); ++i) {
    put(bytes, static_cast<std::uint32_t>(parents[i]));
    bytes.append('\x02');
    const float f = static_cast<float>(parents[i] < 0 ? 0 : parents[i] + 1);
    for (const float v : {length, 0.1f, 1.f, 0.f, 0.f, 0.f, 0.f, 1.f, 0.f, f, 0.f, 0.f, 1.f, 0.f, 1.f, 1.f, 1.f}) {
      bytes.append(reinterpret_cast<const char*>(&v), 4);
    }
  }
  return bytes;
}

}  // namespace

class PrimFormatTest : public QObject {
  Q_OBJECT
 private slots:
  void realFilesHoldWhatTheIndexSays_data();
  void realFilesHoldWhatTheIndexSays();
  void versionsOfOnePlantGiveOneSkeleton();
  void writtenAgainItIsTheSameGraph();
  void obstaclesStandApart();
  void parentsMayStandAfterChildren();
  void twoRootsAreTwoTrees();
  void trailingBytesAreAWarning();
  void badStreamsAreOneLine_data();
  void badStreamsAreOneLine();
  void damagedStreamsNeverCrash();
  void crowdsAtOneNodeAreRead();
};

void PrimFormatTest::realFilesHoldWhatTheIndexSays_data() {
  QTest::addColumn<int>("version");
  QTest::addColumn<int>("leaves");
  QTest::addColumn<int>("stems");
  QTest::addColumn<int>("buds");
  QTest::addColumn<double>("length");
  QTest::newRow("default_502_v4.prim") << 4 << 184 << 300 << 18 << 7.3186;
  QTest::newRow("herb_101_v4.prim") << 4 << 28 << 68 << 5 << 1.4996;
  QTest::newRow("herb_101_v5.prim") << 5 << 28 << 68 << 5 << 1.4996;
  QTest::newRow("herb_101_v6.prim") << 6 << 28 << 68 << 5 << 1.4996;
  QTest::newRow("herb_obstacles_v1.prim") << 1 << 28 << 68 << 5 << 1.4630;
  QTest::newRow("herb_obstacles_v2.prim") << 2 << 28 << 68 << 5 << 1.4630;
  QTest::newRow("tiny_hand_v4.prim") << 4 << 1 << 3 << 1 << 2.0;
  QTest::newRow("tiny_hand_v5.prim") << 5 << 1 << 3 << 1 << 2.0;
  QTest::newRow("tiny_hand_v6.prim") << 6 << 1 << 3 << 1 << 2.0;
  QTest::newRow("v3_sample.prim") << 3 << 21 << 33 << 1 << 1.4378;
}

void PrimFormatTest::realFilesHoldWhatTheIndexSays() {
  const QString name = QTest::currentDataTag();
  const QByteArray bytes = bytesOf(name);
  if (bytes.isEmpty()) QSKIP(qPrintable(name + " is not there"));
  const Result<PrimFile> file = model::readPrim(bytes);
  QVERIFY2(file, file ? "" : file.error().message.c_str());
  QFETCH(int, version);
  QFETCH(int, leaves);
  QFETCH(int, stems);
  QFETCH(int, buds);
  QFETCH(double, length);
  QCOMPARE(file->version, version);
  QCOMPARE(file->warnings, QStringList());
  const SkeletonGraph& graph = file->graph;
  QCOMPARE(graph.plants, 1);
  QCOMPARE(static_cast<int>(graph.leaves.size()), leaves);
  QCOMPARE(static_cast<int>(aboveGround(graph).segments.size()), stems);
  QCOMPARE(static_cast<int>(graph.buds.size()), buds);
  QVERIFY2(std::abs(stemLength(graph) - length) < 5.1e-5 * (version == 1 ? 10 : 1),
           qPrintable(QString::number(stemLength(graph))));
  QVERIFY2(widestGap(graph) < 1e-6f, qPrintable(QString::number(static_cast<double>(widestGap(graph)))));
  int roots = 0;
  for (const model::Segment& s : graph.segments) roots += s.parent < 0 && s.kind != model::SegmentKind::Root;
  QCOMPARE(roots, 1);
  for (const model::LeafOrgan& leaf : graph.leaves) QVERIFY(leaf.segment >= 0);
}

void PrimFormatTest::versionsOfOnePlantGiveOneSkeleton() {
  const QByteArray four = bytesOf("herb_101_v4.prim");
  if (four.isEmpty()) QSKIP("herb_101_v4.prim is not there");
  const SkeletonGraph v4 = model::readPrim(four)->graph;
  SkeletonGraph v5 = test::primFile("herb_101_v5.prim"), v6 = test::primFile("herb_101_v6.prim");
  QVERIFY(std::abs(stemLength(v6, true) - 0.774) < 1e-3);
  QCOMPARE(difference(v4, v5, false), QString());
  QCOMPARE(difference(v4, aboveGround(v6), false), QString());
  for (const SkeletonGraph& graph : {v5, v6}) {
    for (std::size_t i = 0; i < v4.segments.size(); ++i) {
      QCOMPARE(graph.segments[i].state.water, v4.segments[i].state.water);
      QCOMPARE(graph.segments[i].state.energy, v4.segments[i].state.energy);
      QCOMPARE(graph.segments[i].state.wood, v4.segments[i].state.wood);
    }
  }
  // Version 3 has no parents: they are found again from who touches whom.
  for (const char* name : {"herb_101_v4.prim", "default_502_v4.prim"}) {
    const SkeletonGraph graph = test::primFile(name);
    const Result<PrimFile> rebuilt = model::readPrim(*model::writePrim(graph, 3));
    QVERIFY(rebuilt);
    QCOMPARE(difference(graph, rebuilt->graph, false), QString());
  }
}

void PrimFormatTest::writtenAgainItIsTheSameGraph() {
  std::vector<SkeletonGraph> graphs;
  SkeletonGraph made = test::smallTree();
  std::int32_t organ = 0;
  for (model::Segment& s : made.segments) s.organ = organ++, s.state = {0.25f, 0.5f, 0.75f, 0, 1, 2, 3, 4};
  for (model::LeafOrgan& leaf : made.leaves) leaf.organ = organ++, leaf.state = {0.5f, 0.25f, -1, 9, 8, 7, 6, 5};
  for (model::BudOrgan& bud : made.buds) bud.organ = organ++, bud.state = {1, 1, -1, 0, 0, 0, 1, 2};
  graphs.push_back(made);
  for (const char* name : {"herb_101_v5.prim", "herb_101_v6.prim", "tiny_hand_v6.prim", "default_502_v4.prim"}) {
    const SkeletonGraph graph = test::primFile(name);
    if (!graph.segments.empty()) graphs.push_back(graph);
  }
  for (const SkeletonGraph& graph : graphs) {
    const Result<QByteArray> bytes = model::writePrim(graph, 6);
    QVERIFY(bytes);
    const Result<PrimFile> again = model::readPrim(*bytes);
    QVERIFY2(again, again ? "" : again.error().message.c_str());
    QCOMPARE(difference(graph, again->graph, true), QString());
  }
  QVERIFY(!model::writePrim(graphs[0], 2));
  QVERIFY(!model::writePrim(graphs[0], 7));
}

void PrimFormatTest::obstaclesStandApart() {
  for (const char* name : {"herb_obstacles_v1.prim", "herb_obstacles_v2.prim"}) {
    const SkeletonGraph graph = test::primFile(name);
    if (graph.segments.empty()) QSKIP("the plants with obstacles are not there");
    QCOMPARE(graph.obstacles.size(), std::size_t{2});
    for (const model::Obstacle& obstacle : graph.obstacles) {
      QVERIFY(!obstacle.triangles.empty());
      for (const std::uint32_t index : obstacle.triangles) QVERIFY(index < obstacle.points.size());
    }
  }
}

void PrimFormatTest::parentsMayStandAfterChildren() {
  const Result<PrimFile> file = model::readPrim(column({2, 0, -1}));
  QVERIFY(file);
  const auto& segments = file->graph.segments;
  QCOMPARE(segments.size(), std::size_t{3});
  QCOMPARE(segments[0].organ, 2);
  for (std::size_t i = 0; i < 3; ++i) QVERIFY(segments[i].parent < static_cast<int>(i));
}

void PrimFormatTest::twoRootsAreTwoTrees() {
  const Result<PrimFile> file = model::readPrim(column({-1, 0, -1}));
  QVERIFY(file);
  QCOMPARE(file->graph.segments[2].parent, -1);
  QCOMPARE(file->graph.plants, 1);
}

void PrimFormatTest::trailingBytesAreAWarning() {
  const Result<PrimFile> file = model::readPrim(column({-1}) + "xyz");
  QVERIFY(file);
  QCOMPARE(file->warnings.size(), 1);
  QVERIFY(file->warnings[0].contains("3 bytes"));
}

void PrimFormatTest::badStreamsAreOneLine_data() {
  QTest::addColumn<QByteArray>("bytes");
  QTest::addColumn<QString>("says");
  const QByteArray good = column({-1, 0});
  QTest::newRow("empty") << QByteArray() << "is empty";
  QTest::newRow("version") << QByteArray("\x07\x01\x00\x00\x00", 5) << "version 7";
  QTest::newRow("cut off") << good.chopped(5) << "plant 1, organ 1: the file ends";
  QTest::newRow("a gigabyte in five bytes") << QByteArray("\x04\xff\xff\xff\x3f", 5) << "only 0 bytes follow";
  for (char version = 1; version <= 6; ++version) {
    QTest::addRow("lying count in version %d", version)
        << QByteArray(1, version) + QByteArray("\xff\xff\xff\xff\x01\x02\x03\x04\x05\x06\x07\x08", 12) << "claims";
  }
  QByteArray organ = good;
  organ[13] = 9;
  QTest::newRow("unknown organ") << organ << "unknown organ 9";
  QTest::newRow("loop") << column({1, 0}) << "its own ancestor";
  QTest::newRow("its own parent") << column({-1, 1}) << "its own parent";
  QTest::newRow("parent not there") << column({-1, 7}) << "its parent 7 is not there";
  QTest::newRow("negative parent") << column({-1, -5}) << "its parent -5 is not there";
  QTest::newRow("no number") << column({-1}, std::nanf("")) << "no number";
  QTest::newRow("endless") << column({-1}, INFINITY) << "no number";
  QTest::newRow("no plants") << QByteArray("\x04\x00\x00\x00\x00", 5) << "no plants";
  QTest::newRow("no organs") << QByteArray("\x04\x01\x00\x00\x00\x00\x00\x00\x00", 9) << "no organs";
}

void PrimFormatTest::badStreamsAreOneLine() {
  QFETCH(QByteArray, bytes);
  QFETCH(QString, says);
  const Result<PrimFile> file = model::readPrim(bytes);
  QVERIFY(!file);
  const QString message = QString::fromStdString(file.error().message);
  QVERIFY2(message.contains(says), qPrintable(message));
  QVERIFY(!message.contains('\n'));
}

void PrimFormatTest::damagedStreamsNeverCrash() {
  RandomSequence random(5);
  const SkeletonGraph graph = test::smallTree(3);
  for (int version = 3; version <= 6; ++version) {
    const QByteArray good = *model::writePrim(graph, version);
    for (int i = 0; i < 400; ++i) {
      QByteArray bytes = good;
      for (int k = 0; k < 3; ++k) {
        bytes[static_cast<qsizetype>(random.below(static_cast<std::uint32_t>(bytes.size())))] =
            static_cast<char>(random.below(256));
      }
      if (i % 4 == 0) bytes.truncate(static_cast<qsizetype>(random.below(static_cast<std::uint32_t>(bytes.size()))));
      const Result<PrimFile> file = model::readPrim(bytes);
      if (file) {
        QVERIFY(file->graph.segments.size() <= graph.segments.size() + 20);
      } else {
        QVERIFY(!file.error().message.empty());
      }
    }
  }
}

void PrimFormatTest::crowdsAtOneNodeAreRead() {
  SkeletonGraph graph;
  graph.segments.push_back(test::segment({0, 0, 0}, {0, 1, 0}, 0.1f, -1));
  for (int i = 0; i < 100'000; ++i) {
    const float f = static_cast<float>(i);
    graph.segments.push_back(test::segment({0, 1, 0}, {std::sin(f), 1.5f, std::cos(f)}, 0.001f, 0));
  }
  for (const int version : {3, 4}) {
    const Result<PrimFile> file = model::readPrim(*model::writePrim(graph, version));
    QVERIFY(file);
    QCOMPARE(file->graph.segments.size(), graph.segments.size());
    QCOMPARE(file->graph.segments.back().parent, 0);
  }
}

WINDFALL_SUITE(PrimFormatTest)
#include "prim_format.moc"
