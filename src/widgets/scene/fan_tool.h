// Fans in the scene: placed by a click, dragged by their body, turned by the tip of their arrow.
#pragma once

#include "widgets/scene/scene_tools.h"

namespace windfall::widgets {

/// Draws every fan: outlet, jet and arrow; the chosen one brighter, with its handles.
void paintFans(QPainter& painter, const OrbitCamera& camera, QSize size, const std::vector<sim::Fan>& fans, int chosen);

/// What of a fan lies under the pointer.
struct FanHit {
  int fan = -1;
  bool arrow = false;  ///< the tip of its arrow; otherwise its body
};
FanHit fanAt(QPointF position, const OrbitCamera& camera, QSize size, const std::vector<sim::Fan>& fans);
/// World place of the tip of a fan's arrow.
vec3 fanTip(const sim::Fan& fan);

/// A click on empty ground places a fan there, 2 m high, blowing at the nearest tree. Drag its body over the ground
/// (Shift: up and down), its arrow's tip to turn it (Shift: up and down). One drag is one step of undo, Esc takes it
/// back.
class FanTool : public ViewportTool {
 public:
  explicit FanTool(SceneToolHost& host) : host_(host) {}
  bool press(const ViewportEvent& event) override;
  void move(const ViewportEvent& event) override;
  void release(const ViewportEvent& event) override;
  void click(const ViewportEvent& event) override;
  void cancel() override;
  void paint(QPainter& painter, const OrbitCamera& camera, QSize size) const override;

  /// Removes the chosen fan.
  void removeChosen();
  /// A new fan at a place on the ground, chosen.
  void placeFan(vec3 ground);

 private:
  const std::vector<sim::Fan>& fans() const;
  void apply(std::vector<sim::Fan> fans, const QString& text, const QString& merge);

  SceneToolHost& host_;
  std::vector<sim::Fan> before_;
  FanHit grip_;
  QPointF pressed_;
  bool dragging_ = false;
  quint64 gesture_ = 0;
};

}  // namespace windfall::widgets
