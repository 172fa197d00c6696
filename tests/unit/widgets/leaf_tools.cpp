// The leaf tools without a window, through a host that only remembers.
#include <QtTest>

#include "support/suite.h"
#include "widgets/tools/tool.h"

using namespace windfall;
using namespace windfall::widgets;

namespace {

class FakeHost : public ToolHost {
 public:
  FakeHost() {
    model::Leaf leaf;
    leaf.name = QStringLiteral("leaf");
    id = doc.addLeaf(leaf);
    doc.undoStack().clear();
    automatic = QImage(100, 80, QImage::Format_Grayscale8);
    automatic.fill(0);
  }
  model::Document& document() override { return doc; }
  model::AssetId leaf() const override { return id; }
  QImage currentMask() const override {
    const QImage& own = doc.project().leaf(id)->mask;
    return own.isNull() ? automatic : own;
  }
  std::optional<QPointF> currentRoot() const override { return QPointF(50, 70); }
  std::vector<QPointF> currentMarkers() const override {
    const auto& own = doc.project().leaf(id)->markers;
    return own.empty() ? std::vector<QPointF>{{20, 20}, {60, 20}} : own;
  }
  void previewMask(const QImage& mask, QRect) override {
    preview = mask;
    previews += !mask.isNull();
  }
  double pixelSize() const override { return 1; }
  void requestUpdate() override {}
  const model::Leaf& shown() const { return *doc.project().leaf(id); }

  model::Document doc;
  model::AssetId id;
  QImage automatic, preview;
  int previews = 0;
};

ToolEvent at(double x, double y, Qt::KeyboardModifiers modifiers = {}, double pressure = 1) {
  return {{x, y}, Qt::LeftButton, modifiers, pressure, 0};
}

}  // namespace

class LeafTools : public QObject {
  Q_OBJECT

  std::vector<std::unique_ptr<Tool>> tools_ = makeLeafTools();
  Tool& tool(const char* id) {
    for (const auto& tool : tools_) {
      if (tool->id() == QLatin1String(id)) return *tool;
    }
    qFatal("no tool %s", id);
  }

 private slots:
  void everyToolHasANameAHelpAndItsOwnKey() {
    QSet<QString> keys;
    for (const auto& tool : tools_) {
      QVERIFY(!tool->title().isEmpty());
      QVERIFY(!tool->help().isEmpty());
      QVERIFY(!tool->shortcut().isEmpty());
      keys.insert(tool->shortcut().toString());
    }
    QCOMPARE(std::size_t(keys.size()), tools_.size());
  }

  void strokesEndInTheDocumentAndCancelledOnesDoNot_data() {
    QTest::addColumn<QString>("id");
    QTest::addColumn<bool>("cancelled");
    for (const char* id : {"brush", "eraser", "lasso", "root", "marker"}) {
      for (const bool cancelled : {false, true}) {
        QTest::addRow("%s %s", id, cancelled ? "cancelled" : "finished") << QString::fromLatin1(id) << cancelled;
      }
    }
  }
  void strokesEndInTheDocumentAndCancelledOnesDoNot() {
    QFETCH(QString, id);
    QFETCH(bool, cancelled);
    FakeHost host;
    // Half of it leaf, so that erasing shows too.
    for (int y = 0; y < 40; ++y) memset(host.automatic.scanLine(y), 255, 100);
    Tool& used = tool(id.toLatin1().constData());
    if (used.size() > 0) used.setSize(10);
    used.press(at(30, 30), host);
    used.move(at(40, 50), host);
    used.move(at(60, 50), host);
    QCOMPARE(host.doc.undoStack().count(), 0);
    if (cancelled) used.cancel(host);
    used.release({{60, 50}, Qt::NoButton, {}, 0, 0}, host);
    QCOMPARE(host.doc.undoStack().count(), cancelled ? 0 : 1);
    QVERIFY(host.preview.isNull());
    const model::Leaf& leaf = host.shown();
    const bool changed = !leaf.mask.isNull() || leaf.root || !leaf.markers.empty();
    QCOMPARE(changed, !cancelled);
  }

  void pressureNarrowsTheBrush() {
    FakeHost host;
    Tool& brush = tool("brush");
    brush.setSize(20);
    brush.press(at(20, 40, {}, 0.5), host);
    brush.move(at(80, 40, {}, 0.5), host);
    brush.release(at(80, 40), host);
    const QImage& mask = host.shown().mask;
    QCOMPARE(int(mask.constScanLine(43)[50]), 255);
    QCOMPARE(int(mask.constScanLine(47)[50]), 0);
    QVERIFY(host.previews >= 2);
  }

  void ctrlTurnsTheBrushIntoAnEraser() {
    FakeHost host;
    host.automatic.fill(255);
    Tool& brush = tool("brush");
    brush.setSize(20);
    brush.press(at(50, 40, Qt::ControlModifier), host);
    brush.release(at(50, 40, Qt::ControlModifier), host);
    QCOMPARE(int(host.shown().mask.constScanLine(40)[50]), 0);
    QCOMPARE(int(host.shown().mask.constScanLine(10)[10]), 255);
  }

  void aStrokeOutsideThePhotoIsNoEdit() {
    FakeHost host;
    Tool& brush = tool("brush");
    brush.setSize(10);
    brush.press(at(-50, -50), host);
    brush.move(at(-80, -50), host);
    brush.release(at(-80, -50), host);
    QCOMPARE(host.doc.undoStack().count(), 0);
  }

  void theFirstMarkerTakesTheAutomaticOnesOver() {
    FakeHost host;
    Tool& marker = tool("marker");
    marker.press(at(40, 60), host);
    marker.release(at(40, 60), host);
    QCOMPARE(host.shown().markers.size(), std::size_t(3));
    marker.press(at(21, 21, Qt::ControlModifier), host);
    marker.release(at(21, 21, Qt::ControlModifier), host);
    QCOMPARE(host.shown().markers.size(), std::size_t(2));
    QCOMPARE(host.shown().markers.front(), QPointF(60, 20));
  }

  void aMarkerIsMovedByDragging() {
    FakeHost host;
    Tool& marker = tool("marker");
    marker.press(at(22, 20), host);
    marker.move(at(30, 30), host);
    marker.release(at(30, 30), host);
    QCOMPARE(host.shown().markers.size(), std::size_t(2));
    QCOMPARE(host.shown().markers.front(), QPointF(30, 30));
  }
};

WINDFALL_SUITE(LeafTools)
#include "leaf_tools.moc"
