#include "widgets/plant/box_tool.h"

namespace windfall::widgets {
namespace {
constexpr double kClick = 4;  // px
const QColor kLine(0xA6, 0xD6, 0x7B);
}  // namespace

bool BoxTool::press(const ViewportEvent& event) {
  from_ = to_ = event.position;
  dragging_ = true;
  return true;
}

void BoxTool::move(const ViewportEvent& event) { to_ = event.position; }

void BoxTool::release(const ViewportEvent& event) {
  if (!std::exchange(dragging_, false)) return;
  to_ = event.position;
  if ((to_ - from_).manhattanLength() < kClick) {
    clicked_(event);
  } else {
    choose_(box(), event);
  }
}

void BoxTool::paint(QPainter& painter, const OrbitCamera&, QSize) const {
  if (!dragging_) return;
  QColor fill = kLine;
  fill.setAlpha(36);
  painter.setBrush(fill);
  painter.setPen(QPen(kLine, 1));
  painter.drawRect(box());
}

}  // namespace windfall::widgets
