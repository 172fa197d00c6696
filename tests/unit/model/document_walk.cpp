// Thousands of random edits: undo of all is the start, redo of all is the end, and a file between them changes nothing.
#include <QTemporaryDir>
#include <QtTest>

#include "model/document/document.h"
#include "model/document/project_file.h"
#include "model/document/project_json.h"
#include "support/rich_project.h"
#include "support/suite.h"

using namespace windfall;
using namespace windfall::model;

namespace {

/// Random edits by a fixed seed.
class Walker {
 public:
  Walker(Document& document, quint64 seed) : document_(document), state_(seed) {}

  void step() {
    switch (below(18)) {
      case 0:
        document_.addLeaf(named<Leaf>());
        break;
      case 1: {
        Plant plant = named<Plant>();
        plant.leaves = {anyLeaf(), {999999}};
        document_.addPlant(plant);
        break;
      }
      case 2: {
        TreePlacement tree = named<TreePlacement>();
        tree.plant = anyPlant();
        document_.addTree(tree);
        break;
      }
      case 3:
        document_.duplicate(anything());
        break;
      case 4:
        document_.rename(anything(), QStringLiteral("Oak %1").arg(below(4)));
        break;
      case 5:
        document_.remove(anything());
        break;
      case 6:
        paint();
        break;
      case 7:
        document_.setLeaf(anyLeaf(), &Leaf::bladeLength, 0.01 + share(), Aspect::LeafParameters, "Length");
        break;
      case 8:
        drag();
        break;
      case 9:
        document_.setLeaf(anyLeaf(), &Leaf::root, std::optional(QPointF(share(), share())), Aspect::LeafRoot, "Root");
        break;
      case 10:
        document_.setLeaf(anyLeaf(), &Leaf::root, {}, Aspect::LeafRoot, "Root");
        break;
      case 11:
        document_.setLeaf(anyLeaf(), &Leaf::variants, {{state_, true, {}}, {2, false, {}}}, Aspect::LeafVariants,
                          "Variants");
        break;
      case 12:
        document_.setPlant(anyPlant(), &Plant::leaves, {anyLeaf()}, Aspect::PlantLeaves, "Leaves");
        break;
      case 13:
        document_.setPlant(anyPlant(), &Plant::edits, {{"trunk", {1 + share(), 1, 1, 900, 1e9}}}, Aspect::PlantEdits,
                           "Edit");
        break;
      case 14:
        document_.setTree(anyTree(), &TreePlacement::heading, share() * 360, "Turn", "turn");
        break;
      case 15:
        document_.setTree(anyTree(), &TreePlacement::plant, anyPlant(), "Plant");
        break;
      case 16:
        if (document_.undoStack().canUndo()) document_.undoStack().undo();
        break;
      default:
        if (document_.undoStack().canRedo()) document_.undoStack().redo();
    }
  }

  /// Steps of one drag, which sometimes ends where it began.
  void drag() {
    const sim::WindSettings start = document_.project().scene.wind;
    const QString key = QStringLiteral("drag %1").arg(++drags_);
    sim::WindSettings wind = start;
    for (int i = 0; i < 5; ++i) {
      wind.speed = static_cast<float>(share() * 20);
      document_.setScene(&Scene::wind, wind, Aspect::Wind, "Wind", key);
    }
    if (below(2)) document_.setScene(&Scene::wind, start, Aspect::Wind, "Wind", key);
  }

  void paint() {
    const AssetId id = anyLeaf();
    const Leaf* leaf = document_.project().leaf(id);
    if (!leaf) return;
    QImage mask = leaf->mask;
    if (mask.isNull()) {
      mask = QImage(150, 140, QImage::Format_Grayscale8);
      mask.fill(0);
    }
    const QRect dab(below(150) - 10, below(140) - 10, 20, 20);
    const QRect inside = dab.intersected(mask.rect());
    const int value = below(256);
    for (int y = inside.top(); y <= inside.bottom(); ++y) {
      std::memset(mask.scanLine(y) + inside.left(), value, static_cast<size_t>(inside.width()));
    }
    document_.paintMask(id, mask, dab, "Brush");
  }

 private:
  int below(int count) {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<int>((state_ >> 33) % static_cast<quint64>(count));
  }
  double share() { return below(1 << 20) / 1048576.0; }
  template <class T>
  T named() {
    T item;
    item.name = QStringLiteral("Oak");
    return item;
  }
  template <class T>
  AssetId any(const std::vector<T>& items) {
    return items.empty() ? AssetId{} : items[static_cast<size_t>(below(static_cast<int>(items.size())))].id;
  }
  AssetId anyLeaf() { return any(document_.project().leaves); }
  AssetId anyPlant() { return any(document_.project().plants); }
  AssetId anyTree() { return any(document_.project().scene.trees); }
  AssetId anything() {
    const int kind = below(3);
    return kind == 0 ? anyLeaf() : kind == 1 ? anyPlant() : anyTree();
  }

  Document& document_;
  quint64 state_;
  int drags_ = 0;
};

}  // namespace

class DocumentWalkTest : public QObject {
  Q_OBJECT
 private slots:
  void undoAllIsTheStartAndRedoAllTheEnd_data();
  void undoAllIsTheStartAndRedoAllTheEnd();
};

void DocumentWalkTest::undoAllIsTheStartAndRedoAllTheEnd_data() {
  QTest::addColumn<quint64>("seed");
  for (quint64 seed = 1; seed <= 4; ++seed) QTest::addRow("seed %d", static_cast<int>(seed)) << seed;
}

void DocumentWalkTest::undoAllIsTheStartAndRedoAllTheEnd() {
  QFETCH(quint64, seed);
  QTemporaryDir folder;
  const QString path = folder.filePath("walk.windfall");
  Progress progress;
  Document document;
  document.open(test::richProject(), {});
  const Project start = document.project();
  int announced = 0;
  connect(&document, &Document::changed, this, [&](const Change&) { ++announced; });

  Walker walker(document, seed);
  for (int i = 0; i < 2000; ++i) {
    const Project before = i % 50 ? Project() : document.project();
    const int wasAt = document.undoStack().index();
    announced = 0;
    walker.step();
    QVERIFY(document.undoStack().index() == wasAt || announced > 0);
    if (i % 50) continue;
    const QString broken = checkProject(document.project());
    QVERIFY2(broken.isEmpty(), qPrintable(broken));
    if (document.undoStack().index() > wasAt) {
      document.undoStack().undo();
      QVERIFY(document.project() == before);
      document.undoStack().redo();
    }
    if (i % 500) continue;
    QVERIFY(document.save(path, progress));
    const Result<Project> read = readProject(path, progress);
    QVERIFY2(read, read ? "" : read.error().message.c_str());
    QVERIFY(*read == document.project());
  }

  const Project end = document.project();
  const int top = document.undoStack().count();
  document.undoStack().setIndex(top);
  const Project last = document.project();
  document.undoStack().setIndex(0);
  QVERIFY(document.project() == start);
  document.undoStack().setIndex(top);
  QVERIFY(document.project() == last);
  QVERIFY(top > 300);
  QVERIFY(!(end == start));
}

WINDFALL_SUITE(DocumentWalkTest)
#include "document_walk.moc"
