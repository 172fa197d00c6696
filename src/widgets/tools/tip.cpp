// Tips: where the main veins end.
#include <QCoreApplication>
#include <QPainter>
#include <cmath>

#include "widgets/tools/leaf_tools.h"

namespace windfall::widgets {

namespace {

class TipTool : public Tool {
 public:
  QString id() const override { return QStringLiteral("tip"); }
  QString title() const override { return QCoreApplication::translate("Tools", "Tips"); }
  QString help() const override {
    return QCoreApplication::translate("Tools",
                                       "Click or drag to the leaf's tip. Shift+click adds the tip of a further main "
                                       "vein, Ctrl+click takes one away; without any they are found.");
  }
  QKeySequence shortcut() const override { return Qt::Key_T; }
  std::optional<model::Stage> stage() const override { return model::Stage::Contour; }

  void press(const ToolEvent& event, ToolHost& host) override {
    if (!(event.buttons & Qt::LeftButton)) return;
    tips_ = host.currentTips();
    held_ = nearest(event.position, 10 * host.pixelSize());
    if (event.modifiers & Qt::ControlModifier) {
      if (held_ < 0) return;
      tips_.erase(tips_.begin() + held_);
      commit(QCoreApplication::translate("Tools", "Remove tip"), host);
      return;
    }
    if (held_ < 0 && (event.modifiers & Qt::ShiftModifier || tips_.empty())) {
      held_ = int(tips_.size());
      tips_.push_back(event.position);
    } else if (held_ < 0) {
      // A plain click means the tip of all tips.
      held_ = 0;
      tips_.front() = event.position;
    }
    active_ = true;
    host.requestUpdate();
  }
  void move(const ToolEvent& event, ToolHost& host) override {
    if (!active_) return;
    tips_[std::size_t(held_)] = event.position;
    host.requestUpdate();
  }
  void release(const ToolEvent&, ToolHost& host) override {
    if (!std::exchange(active_, false)) return;
    commit(QCoreApplication::translate("Tools", "Set tip"), host);
    host.requestUpdate();
  }
  void cancel(ToolHost& host) override {
    active_ = false;
    host.requestUpdate();
  }
  void paint(QPainter& painter, const ToolHost& host) const override {
    const double pixel = host.pixelSize();
    bool first = true;
    for (const QPointF& tip : active_ ? tips_ : host.currentTips()) {
      painter.setBrush(first ? QColor(255, 96, 160) : QColor(255, 190, 214));
      painter.setPen(QPen(QColor(0, 0, 0, 190), 1.5 * pixel));
      const double r = (first ? 6 : 4.5) * pixel;
      painter.drawPolygon(
          QPolygonF({tip + QPointF(0, -r), tip + QPointF(r, 0), tip + QPointF(0, r), tip + QPointF(-r, 0)}));
      first = false;
    }
  }

 private:
  int nearest(QPointF at, double reach) const {
    int best = -1;
    for (std::size_t i = 0; i < tips_.size(); ++i) {
      const QPointF d = tips_[i] - at;
      if (std::hypot(d.x(), d.y()) > reach) continue;
      reach = std::hypot(d.x(), d.y());
      best = int(i);
    }
    return best;
  }
  void commit(const QString& text, ToolHost& host) {
    host.document().setLeaf(host.leaf(), &model::Leaf::tips, tips_, model::Aspect::LeafRoot, text);
  }

  std::vector<QPointF> tips_;
  int held_ = -1;
  bool active_ = false;
};

}  // namespace

std::unique_ptr<Tool> makeTipTool() { return std::make_unique<TipTool>(); }

}  // namespace windfall::widgets
