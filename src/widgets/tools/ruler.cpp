// Ruler: two places of the photo whose distance is known.
#include <QCoreApplication>
#include <QLineF>
#include <QPainter>

#include "widgets/tools/leaf_tools.h"

namespace windfall::widgets {

namespace {

class RulerTool : public Tool {
 public:
  QString id() const override { return QStringLiteral("ruler"); }
  QString title() const override { return QCoreApplication::translate("Tools", "Ruler"); }
  QString help() const override {
    return QCoreApplication::translate("Tools",
                                       "Drag along something of known length, then give the length under Source. Ends "
                                       "can be dragged. Ctrl+click takes the ruler away.");
  }
  QKeySequence shortcut() const override { return Qt::Key_U; }

  void press(const ToolEvent& event, ToolHost& host) override {
    if (!(event.buttons & Qt::LeftButton)) return;
    const model::Ruler known = ruler(host);
    if (event.modifiers & Qt::ControlModifier) {
      model::Ruler none;
      none.metres = known.metres;
      set(none, QCoreApplication::translate("Tools", "Remove ruler"), host);
      return;
    }
    held_ = known;
    const double reach = 10 * host.pixelSize();
    const auto near = [&](const std::optional<QPointF>& end) {
      return end && QLineF(*end, event.position).length() < reach;
    };
    movesFrom_ = near(known.from);
    if (!movesFrom_ && !near(known.to)) held_.from = event.position;
    (movesFrom_ ? held_.from : held_.to) = event.position;
    active_ = true;
    host.requestUpdate();
  }
  void move(const ToolEvent& event, ToolHost& host) override {
    if (!active_) return;
    (movesFrom_ ? held_.from : held_.to) = event.position;
    host.requestUpdate();
  }
  void release(const ToolEvent&, ToolHost& host) override {
    if (!std::exchange(active_, false)) return;
    // A click alone measures nothing.
    if (QLineF(*held_.from, *held_.to).length() >= 4 * host.pixelSize()) {
      set(held_, QCoreApplication::translate("Tools", "Set ruler"), host);
    }
    host.requestUpdate();
  }
  void cancel(ToolHost& host) override {
    active_ = false;
    host.requestUpdate();
  }
  void paint(QPainter& painter, const ToolHost& host) const override {
    const model::Ruler shown = active_ ? held_ : ruler(host);
    if (!shown.isSet()) return;
    const double pixel = host.pixelSize();
    const QLineF line(*shown.from, *shown.to);
    const QLineF across = line.normalVector().unitVector();
    const QPointF tick = (across.p2() - across.p1()) * 7 * pixel;
    for (const auto& [color, width] : {std::pair(QColor(0, 0, 0, 190), 4.0), std::pair(QColor(255, 214, 92), 2.0)}) {
      painter.setPen(QPen(color, width * pixel, Qt::SolidLine, Qt::RoundCap));
      painter.drawLine(line);
      painter.drawLine(line.p1() - tick, line.p1() + tick);
      painter.drawLine(line.p2() - tick, line.p2() + tick);
    }
  }

 private:
  static model::Ruler ruler(const ToolHost& host) {
    const model::Leaf* leaf = const_cast<ToolHost&>(host).document().project().leaf(host.leaf());
    return leaf ? leaf->ruler : model::Ruler();
  }
  static void set(const model::Ruler& value, const QString& text, ToolHost& host) {
    host.document().setLeaf(host.leaf(), &model::Leaf::ruler, value, model::Aspect::LeafParameters, text);
  }

  model::Ruler held_;
  bool active_ = false, movesFrom_ = false;
};

}  // namespace

std::unique_ptr<Tool> makeRulerTool() { return std::make_unique<RulerTool>(); }

}  // namespace windfall::widgets
