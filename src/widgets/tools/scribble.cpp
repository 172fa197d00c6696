// Scribble: rough strokes on leaf and on ground, and the mask's border follows the picture (GrabCut).
#include <QCoreApplication>
#include <QPainter>
#include <QPolygonF>
#include <algorithm>

#include "model/leaf/mask_edit.h"
#include "widgets/tools/leaf_tools.h"

namespace windfall::widgets {

namespace {

class ScribbleTool : public Tool {
 public:
  QString id() const override { return QStringLiteral("scribble"); }
  QString title() const override { return QCoreApplication::translate("Tools", "Scribble (GrabCut)"); }
  QString help() const override {
    return QCoreApplication::translate("Tools",
                                       "Scribble roughly over leaf that is missing, with Ctrl over what is not leaf: "
                                       "the border finds the edges. [ and ]: width.");
  }
  QKeySequence shortcut() const override { return Qt::Key_G; }
  std::optional<model::Stage> stage() const override { return model::Stage::Mask; }
  double size() const override { return size_; }
  void setSize(double size) override { size_ = std::clamp(size, 1.0, 2000.0); }

  void press(const ToolEvent& event, ToolHost& host) override {
    if (!(event.buttons & Qt::LeftButton)) return;
    if (host.leaf() != leaf_) earlier_.clear();
    leaf_ = host.leaf();
    stroke_ = {{event.position}, std::max(1.0, 0.5 * size_ * event.pressure), !(event.modifiers & Qt::ControlModifier)};
    active_ = true;
    host.requestUpdate();
  }
  void move(const ToolEvent& event, ToolHost& host) override {
    if (active_) stroke_.points.push_back(event.position);
    if (active_) host.requestUpdate();
  }
  void release(const ToolEvent&, ToolHost& host) override {
    if (!std::exchange(active_, false)) return;
    host.requestUpdate();
    const model::LeafStages* stages = host.stages();
    const QImage mask = host.currentMask();
    if (!stages || mask.isNull()) return;
    // What was said before still holds, as long as this tool is in hand.
    earlier_.push_back(stroke_);
    host.computeMask(QCoreApplication::translate("Tools", "Refine mask"),
                     [mask, photo = stages->photo, scribbles = earlier_](model::Progress&) -> Result<QImage> {
                       return model::refinedMask(mask, photo, scribbles);
                     });
  }
  void cancel(ToolHost& host) override {
    active_ = false;
    earlier_.clear();
    host.requestUpdate();
  }
  void paint(QPainter& painter, const ToolHost& host) const override {
    if (host.leaf() == leaf_) {
      for (const model::Scribble& scribble : earlier_) draw(painter, scribble, 90);
    }
    if (active_) draw(painter, stroke_, 200);
  }

 private:
  static void draw(QPainter& painter, const model::Scribble& scribble, int alpha) {
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(scribble.leaf ? QColor(120, 230, 90, alpha) : QColor(240, 90, 80, alpha), scribble.width,
                        Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    painter.drawPolyline(QPolygonF(QList<QPointF>(scribble.points.begin(), scribble.points.end())));
  }

  model::AssetId leaf_;
  model::Scribble stroke_;
  std::vector<model::Scribble> earlier_;
  double size_ = 48;
  bool active_ = false;
};

}  // namespace

std::unique_ptr<Tool> makeScribbleTool() { return std::make_unique<ScribbleTool>(); }

}  // namespace windfall::widgets
