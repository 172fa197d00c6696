// Tools of the scene's canvas: choose, move and turn trees.
#pragma once

#include <functional>
#include <vector>

#include "model/document/document.h"
#include "widgets/scene/scene_selection.h"
#include "widgets/viewport/viewport_tool.h"

namespace windfall::widgets {

/// What the scene's tools may ask of whoever hosts them.
class SceneToolHost {
 public:
  virtual ~SceneToolHost() = default;
  virtual model::Document& document() = 0;
  virtual SceneSelection& selection() = 0;
  /// The tree under the pointer (0: none), with the place that the ray meets. Asks for the rest pose: at once, and near
  /// enough for whole trees.
  virtual model::AssetId treeAt(const Ray& ray, float slack, vec3* place) = 0;
};

/// A click chooses; a drag is left to the camera.
class SelectTreesTool : public ViewportTool {
 public:
  explicit SelectTreesTool(SceneToolHost& host) : host_(host) {}
  void click(const ViewportEvent& event) override;
  void paint(QPainter& painter, const OrbitCamera& camera, QSize size) const override;

 protected:
  /// The tree below the pointer joins the selection if it was not chosen; false: none is there.
  bool grab(const ViewportEvent& event, vec3* place);
  SceneToolHost& host_;
};

/// What moving and turning have in common: one drag is one step of undo, Esc takes it back.
class DragTreesTool : public SelectTreesTool {
 public:
  using SelectTreesTool::SelectTreesTool;
  bool press(const ViewportEvent& event) override;
  void move(const ViewportEvent& event) override;
  void release(const ViewportEvent& event) override;
  void cancel() override;

 protected:
  /// The tree as it was when the drag began, to where the pointer is now.
  virtual void drag(model::TreePlacement& tree, const ViewportEvent& event) const = 0;
  virtual QString text() const = 0;
  /// Starts a drag that grabbed `place`; always true.
  bool begin(const ViewportEvent& event, vec3 place);
  QPointF pressed_;
  vec3 place_{0};  ///< world place that was grabbed

 private:
  void apply(const std::vector<model::TreePlacement>& trees);

  std::vector<model::TreePlacement> before_;
  bool dragging_ = false;
  quint64 gesture_ = 0;
};

/// Over the ground, along what the pointer does on the screen.
class MoveTreesTool : public DragTreesTool {
 public:
  using DragTreesTool::DragTreesTool;

 protected:
  void drag(model::TreePlacement& tree, const ViewportEvent& event) const override;
  QString text() const override;
};

/// About the vertical through each tree; Shift snaps to 15 degrees. The ring round a chosen tree is its handle.
class TurnTreesTool : public DragTreesTool {
 public:
  using DragTreesTool::DragTreesTool;
  bool press(const ViewportEvent& event) override;
  void paint(QPainter& painter, const OrbitCamera& camera, QSize size) const override;

 protected:
  void drag(model::TreePlacement& tree, const ViewportEvent& event) const override;
  QString text() const override;
};

}  // namespace windfall::widgets
