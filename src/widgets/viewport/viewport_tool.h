// Tools of a viewport: small state machines over plain events, tested without a window.
#pragma once

#include <QPainter>
#include <QPointF>
#include <QSize>
#include <Qt>

#include "widgets/viewport/orbit_camera.h"

namespace windfall::widgets {

/// A pointer event; positions in widget pixels, with the camera that maps them to the world.
struct ViewportEvent {
  QPointF position;
  Qt::MouseButton button = Qt::NoButton;
  Qt::KeyboardModifiers modifiers;
  const OrbitCamera& camera;
  QSize size;
};

/// Angle, in radians, by which a click may miss what is too thin to be met.
inline float pickSlack(const ViewportEvent& event) {
  constexpr double kPixels = 7;
  return static_cast<float>(kPixels * event.camera.pixelSize(event.camera.target(), event.size) /
                            event.camera.state().distance);
}

class ViewportTool {
 public:
  virtual ~ViewportTool() = default;
  /// Left button pressed; true takes the drag, otherwise it orbits.
  virtual bool press(const ViewportEvent&) { return false; }
  virtual void move(const ViewportEvent&) {}
  virtual void release(const ViewportEvent&) {}
  /// Pressed and released in place, where the drag was not taken.
  virtual void click(const ViewportEvent&) {}
  /// Esc, a change of tool, the document closes: back to where the drag began.
  virtual void cancel() {}
  /// Handles over the picture.
  virtual void paint(QPainter&, const OrbitCamera&, QSize) const {}
};

}  // namespace windfall::widgets
