// Choosing branches by a rectangle.
#pragma once

#include <QRectF>
#include <functional>

#include "widgets/viewport/viewport_tool.h"

namespace windfall::widgets {

class BoxTool : public ViewportTool {
 public:
  using Choose = std::function<void(const QRectF& box, const ViewportEvent& event)>;
  using Click = std::function<void(const ViewportEvent& event)>;
  BoxTool(Choose choose, Click clicked) : choose_(std::move(choose)), clicked_(std::move(clicked)) {}
  bool press(const ViewportEvent& event) override;
  void move(const ViewportEvent& event) override;
  void release(const ViewportEvent& event) override;
  void cancel() override { dragging_ = false; }
  void paint(QPainter& painter, const OrbitCamera& camera, QSize size) const override;

 private:
  QRectF box() const { return QRectF(from_, to_).normalized(); }
  Choose choose_;
  Click clicked_;
  QPointF from_, to_;
  bool dragging_ = false;
};

}  // namespace windfall::widgets
