// Mask brush and eraser: the same stroke with another value.
#include <QCoreApplication>
#include <QPainter>
#include <cmath>

#include "widgets/tools/leaf_tools.h"
#include "widgets/tools/mask_stroke.h"

namespace windfall::widgets {

namespace {

constexpr double kSmallest = 1, kLargest = 2000;  // px

class Brush : public Tool {
 public:
  explicit Brush(bool erases) : erases_(erases) {}

  QString id() const override { return erases_ ? QStringLiteral("eraser") : QStringLiteral("brush"); }
  QString title() const override {
    return erases_ ? QCoreApplication::translate("Tools", "Mask eraser")
                   : QCoreApplication::translate("Tools", "Mask brush");
  }
  QString help() const override {
    return erases_ ? QCoreApplication::translate(
                         "Tools", "Drag over what is not leaf. [ and ] or Shift+drag: size. Ctrl: paint instead.")
                   : QCoreApplication::translate(
                         "Tools", "Drag over what is leaf. [ and ] or Shift+drag: size. Ctrl: erase instead.");
  }
  QKeySequence shortcut() const override { return erases_ ? Qt::Key_E : Qt::Key_B; }
  Qt::CursorShape cursor() const override { return Qt::BlankCursor; }
  std::optional<model::Stage> stage() const override { return model::Stage::Mask; }
  double size() const override { return size_; }
  void setSize(double size) override { size_ = std::clamp(size, kSmallest, kLargest); }

  void press(const ToolEvent& event, ToolHost& host) override {
    if (!(event.buttons & Qt::LeftButton)) return;
    last_ = pointer_ = event.position;
    if (event.modifiers & Qt::ShiftModifier) {
      resizing_ = true;
      sizeBefore_ = size_;
      return;
    }
    value_ = erases_ != bool(event.modifiers & Qt::ControlModifier) ? 0 : 255;
    if (stroke_.begin(host)) stroke_.line(last_, last_, width(event), value_, host);
  }

  void move(const ToolEvent& event, ToolHost& host) override {
    if (resizing_) {
      // A screen pixel to the side is a screen pixel of diameter, so the circle follows the pointer.
      setSize(sizeBefore_ + 2 * (event.position.x() - last_.x()));
    } else {
      pointer_ = event.position;
      if (stroke_.isActive()) {
        stroke_.line(last_, event.position, width(event), value_, host);
        last_ = event.position;
      }
    }
    host.requestUpdate();
  }

  void release(const ToolEvent&, ToolHost& host) override {
    resizing_ = false;
    stroke_.finish(value_ ? QCoreApplication::translate("Tools", "Paint mask")
                          : QCoreApplication::translate("Tools", "Erase mask"),
                   host);
  }

  void cancel(ToolHost& host) override {
    if (resizing_) size_ = sizeBefore_;
    resizing_ = false;
    stroke_.cancel(host);
    host.requestUpdate();
  }

  void paint(QPainter& painter, const ToolHost& host) const override {
    drawBrush(painter, pointer_, size_, host.pixelSize());
  }

 private:
  double width(const ToolEvent& event) const { return std::max(1.0, size_ * event.pressure); }

  bool erases_, resizing_ = false;
  double size_ = 48, sizeBefore_ = 48;
  int value_ = 255;
  QPointF last_, pointer_;
  MaskStroke stroke_;
};

}  // namespace

std::unique_ptr<Tool> makeBrush(bool erases) { return std::make_unique<Brush>(erases); }

}  // namespace windfall::widgets
