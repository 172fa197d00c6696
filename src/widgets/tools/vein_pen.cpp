// Vein pen: veins drawn by hand.
#include <QCoreApplication>
#include <QPainter>
#include <QPolygonF>
#include <algorithm>
#include <cmath>

#include "model/leaf/contour.h"
#include "model/leaf/vein_curve.h"
#include "model/leaf/vein_graph.h"
#include "widgets/tools/leaf_tools.h"
#include "widgets/tools/vein_look.h"

namespace windfall::widgets {

namespace {

class VeinPen : public Tool {
 public:
  QString id() const override { return QStringLiteral("vein"); }
  QString title() const override { return QCoreApplication::translate("Tools", "Vein pen"); }
  QString help() const override {
    return QCoreApplication::translate("Tools",
                                       "Draw a vein from where it leaves another. Pressure: width; Alt: straight. The "
                                       "veins that were grown become yours to edit. [ and ]: width.");
  }
  QKeySequence shortcut() const override { return Qt::Key_P; }
  std::optional<model::Stage> stage() const override { return model::Stage::Veins; }
  double size() const override { return size_; }
  void setSize(double size) override { size_ = std::clamp(size, 6.0, 2000.0); }

  std::vector<ToolOption> options(ToolHost&) const override {
    return {
        {QStringLiteral("width"), QCoreApplication::translate("Tools", "Width"), QStringLiteral("px"),
         QCoreApplication::translate("Tools", "Where the vein begins, at full pressure; it ends at two fifths of it"),
         size_ / kSizeOfWidth, 0.5, 60, size_ / kSizeOfWidth, 1},
        orderOption(order_, true)};
  }
  void setOption(const QString& id, double value, const QString&, ToolHost&) override {
    if (id == QLatin1String("width")) setSize(value * kSizeOfWidth);
    if (id == QLatin1String("order")) order_ = static_cast<int>(value);
  }

  void press(const ToolEvent& event, ToolHost& host) override {
    if (!(event.buttons & Qt::LeftButton)) return;
    points_ = {event.position};
    widest_ = event.pressure;
    active_ = true;
    host.requestUpdate();
  }
  void move(const ToolEvent& event, ToolHost& host) override {
    if (!active_) return;
    if (event.modifiers & Qt::AltModifier) {
      points_ = {points_.front(), event.position};
    } else {
      points_.push_back(event.position);
    }
    widest_ = std::max(widest_, event.pressure);
    host.requestUpdate();
  }
  void release(const ToolEvent&, ToolHost& host) override {
    if (!std::exchange(active_, false)) return;
    host.requestUpdate();
    const double pixel = host.pixelSize();
    if (model::lengthOf(points_) < 6 * pixel) return;
    const double width = this->width();
    const model::Veins before = handVeins(host);
    model::Veins after = model::withVein(before, model::simplifyLine(points_, 1.2 * pixel), width, 0.4 * width,
                                         std::max(14 * pixel, 2 * width));
    if (order_ > 0) after = model::withOrder(std::move(after), static_cast<int>(after.size()) - 1, order_);
    host.document().setLeaf(host.leaf(), &model::Leaf::veins, after, model::Aspect::LeafVeins,
                            QCoreApplication::translate("Tools", "Draw a vein"));
  }
  void cancel(ToolHost& host) override {
    active_ = false;
    points_.clear();
    host.requestUpdate();
  }
  void paint(QPainter& painter, const ToolHost& host) const override {
    if (!active_) return;
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(QColor(0, 0, 0, 150), width() + 2 * host.pixelSize(), Qt::SolidLine, Qt::RoundCap));
    const QPolygonF line(QList<QPointF>(points_.begin(), points_.end()));
    painter.drawPolyline(line);
    painter.setPen(QPen(QColor(255, 226, 120), width(), Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    painter.drawPolyline(line);
  }

 private:
  /// A twelfth of a mask brush: veins are thin.
  double width() const { return std::max(0.5, size_ / kSizeOfWidth * widest_); }
  static constexpr double kSizeOfWidth = 12;

  std::vector<QPointF> points_;
  double size_ = 48, widest_ = 1;
  int order_ = 0;  ///< 0: one below the vein that it leaves
  bool active_ = false;
};

}  // namespace

std::unique_ptr<Tool> makeVeinPen() { return std::make_unique<VeinPen>(); }

}  // namespace windfall::widgets
