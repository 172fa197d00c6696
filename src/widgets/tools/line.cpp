// Straight line: a brush stroke from press to release.
#include <QCoreApplication>
#include <QPainter>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "widgets/tools/leaf_tools.h"
#include "widgets/tools/mask_stroke.h"

namespace windfall::widgets {

namespace {

class LineTool : public Tool {
 public:
  QString id() const override { return QStringLiteral("line"); }
  QString title() const override { return QCoreApplication::translate("Tools", "Straight mask line"); }
  QString help() const override {
    return QCoreApplication::translate(
        "Tools", "Drag a straight stroke of leaf. Ctrl: erase instead. Shift: in steps of 15°. [ and ]: width.");
  }
  QKeySequence shortcut() const override { return Qt::Key_V; }
  std::optional<model::Stage> stage() const override { return model::Stage::Mask; }
  double size() const override { return size_; }
  void setSize(double size) override { size_ = std::clamp(size, 1.0, 2000.0); }

  void press(const ToolEvent& event, ToolHost& host) override {
    if (!(event.buttons & Qt::LeftButton)) return;
    from_ = to_ = event.position;
    erases_ = event.modifiers & Qt::ControlModifier;
    active_ = true;
    host.requestUpdate();
  }
  void move(const ToolEvent& event, ToolHost& host) override {
    pointer_ = event.position;
    if (active_) to_ = event.modifiers & Qt::ShiftModifier ? snapped(event.position) : event.position;
    host.requestUpdate();
  }
  void release(const ToolEvent&, ToolHost& host) override {
    if (!std::exchange(active_, false)) return;
    MaskStroke stroke;
    if (stroke.begin(host)) {
      stroke.line(from_, to_, size_, erases_ ? 0 : 255, host);
      stroke.finish(erases_ ? QCoreApplication::translate("Tools", "Erase a line")
                            : QCoreApplication::translate("Tools", "Paint a line"),
                    host);
    }
    host.requestUpdate();
  }
  void cancel(ToolHost& host) override {
    active_ = false;
    host.requestUpdate();
  }
  void paint(QPainter& painter, const ToolHost& host) const override {
    if (active_) {
      painter.setPen(
          QPen(erases_ ? QColor(255, 120, 120, 150) : QColor(150, 255, 150, 150), size_, Qt::SolidLine, Qt::RoundCap));
      painter.drawLine(from_, to_);
      return;
    }
    drawBrush(painter, pointer_, size_, host.pixelSize());
  }

 private:
  QPointF snapped(QPointF to) const {
    const QPointF way = to - from_;
    const double step = std::numbers::pi / 12;
    const double angle = std::round(std::atan2(way.y(), way.x()) / step) * step;
    return from_ + std::hypot(way.x(), way.y()) * QPointF(std::cos(angle), std::sin(angle));
  }

  QPointF from_, to_, pointer_;
  double size_ = 48;
  bool active_ = false, erases_ = false;
};

}  // namespace

std::unique_ptr<Tool> makeLineTool() { return std::make_unique<LineTool>(); }

}  // namespace windfall::widgets
