// Region markers: each is the seed of a region of the blade.
#include <QCoreApplication>
#include <QPainter>
#include <cmath>

#include "widgets/tools/leaf_tools.h"

namespace windfall::widgets {

namespace {

constexpr double kReach = 10;  // screen px

class MarkerTool : public Tool {
 public:
  QString id() const override { return QStringLiteral("marker"); }
  QString title() const override { return QCoreApplication::translate("Tools", "Region marker"); }
  QString help() const override {
    return QCoreApplication::translate("Tools",
                                       "Click adds a region, drag moves its marker, Ctrl+click takes it away.");
  }
  QKeySequence shortcut() const override { return Qt::Key_M; }
  std::optional<model::Stage> stage() const override { return model::Stage::Regions; }

  void press(const ToolEvent& event, ToolHost& host) override {
    if (!(event.buttons & Qt::LeftButton)) return;
    // The first edit takes the automatic markers over: a click adds to what is seen.
    markers_ = host.currentMarkers();
    held_ = nearest(event.position, kReach * host.pixelSize());
    if (event.modifiers & Qt::ControlModifier) {
      if (held_ >= 0) {
        markers_.erase(markers_.begin() + held_);
        commit(QCoreApplication::translate("Tools", "Remove region marker"), host);
      }
      stop();
      return;
    }
    added_ = held_ < 0;
    if (added_) {
      held_ = int(markers_.size());
      markers_.push_back(event.position);
    }
    active_ = true;
    host.requestUpdate();
  }
  void move(const ToolEvent& event, ToolHost& host) override {
    if (!active_) return;
    markers_[std::size_t(held_)] = event.position;
    host.requestUpdate();
  }
  void release(const ToolEvent&, ToolHost& host) override {
    if (!active_) return;
    commit(added_ ? QCoreApplication::translate("Tools", "Add region marker")
                  : QCoreApplication::translate("Tools", "Move region marker"),
           host);
    stop();
    host.requestUpdate();
  }
  void cancel(ToolHost& host) override {
    stop();
    host.requestUpdate();
  }
  void paint(QPainter& painter, const ToolHost& host) const override {
    const double pixel = host.pixelSize();
    for (const QPointF& marker : active_ ? markers_ : host.currentMarkers()) {
      painter.setPen(QPen(QColor(0, 0, 0, 180), 1.5 * pixel));
      painter.setBrush(Qt::white);
      painter.drawEllipse(marker, 4.5 * pixel, 4.5 * pixel);
    }
  }

 private:
  int nearest(QPointF at, double reach) const {
    int best = -1;
    for (std::size_t i = 0; i < markers_.size(); ++i) {
      const QPointF d = markers_[i] - at;
      const double distance = std::hypot(d.x(), d.y());
      if (distance > reach) continue;
      reach = distance;
      best = int(i);
    }
    return best;
  }
  void commit(const QString& text, ToolHost& host) {
    host.document().setLeaf(host.leaf(), &model::Leaf::markers, markers_, model::Aspect::LeafMarkers, text);
  }
  void stop() {
    active_ = false;
    held_ = -1;
    markers_.clear();
  }

  std::vector<QPointF> markers_;
  int held_ = -1;
  bool active_ = false, added_ = false;
};

}  // namespace

std::unique_ptr<Tool> makeMarkerTool() { return std::make_unique<MarkerTool>(); }

}  // namespace windfall::widgets
