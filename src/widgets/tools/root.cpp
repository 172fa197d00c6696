// Root: where the petiole meets the blade.
#include <QCoreApplication>
#include <QPainter>

#include "widgets/tools/leaf_tools.h"

namespace windfall::widgets {

namespace {

class RootTool : public Tool {
 public:
  QString id() const override { return QStringLiteral("root"); }
  QString title() const override { return QCoreApplication::translate("Tools", "Root"); }
  QString help() const override {
    return QCoreApplication::translate(
        "Tools", "Click or drag to where the petiole meets the blade. Ctrl+click: find it automatically.");
  }
  QKeySequence shortcut() const override { return Qt::Key_R; }
  std::optional<model::Stage> stage() const override { return model::Stage::Contour; }

  void press(const ToolEvent& event, ToolHost& host) override {
    if (!(event.buttons & Qt::LeftButton)) return;
    if (event.modifiers & Qt::ControlModifier) {
      host.document().setLeaf(host.leaf(), &model::Leaf::root, std::optional<QPointF>(), model::Aspect::LeafRoot,
                              QCoreApplication::translate("Tools", "Automatic root"));
      return;
    }
    dragged_ = event.position;
    host.requestUpdate();
  }
  void move(const ToolEvent& event, ToolHost& host) override {
    if (!dragged_) return;
    dragged_ = event.position;
    host.requestUpdate();
  }
  void release(const ToolEvent&, ToolHost& host) override {
    if (!dragged_) return;
    const std::optional<QPointF> root = std::exchange(dragged_, std::nullopt);
    host.document().setLeaf(host.leaf(), &model::Leaf::root, root, model::Aspect::LeafRoot,
                            QCoreApplication::translate("Tools", "Set root"));
    host.requestUpdate();
  }
  void cancel(ToolHost& host) override {
    dragged_.reset();
    host.requestUpdate();
  }
  void paint(QPainter& painter, const ToolHost& host) const override {
    const std::optional<QPointF> root = dragged_ ? dragged_ : host.currentRoot();
    if (!root) return;
    const double pixel = host.pixelSize();
    painter.setBrush(QColor(255, 255, 255, 60));
    painter.setPen(QPen(QColor(0, 0, 0, 180), 4 * pixel));
    painter.drawEllipse(*root, 8 * pixel, 8 * pixel);
    painter.setPen(QPen(QColor(255, 214, 92), 2 * pixel));
    painter.drawEllipse(*root, 8 * pixel, 8 * pixel);
    painter.setBrush(QColor(255, 214, 92));
    painter.setPen(Qt::NoPen);
    painter.drawEllipse(*root, 2 * pixel, 2 * pixel);
  }

 private:
  std::optional<QPointF> dragged_;
};

}  // namespace

std::unique_ptr<Tool> makeRootTool() { return std::make_unique<RootTool>(); }

}  // namespace windfall::widgets
