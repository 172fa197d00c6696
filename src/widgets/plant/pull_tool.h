// A hand on a branch while it sways.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "sim/pull.h"
#include "widgets/viewport/picking.h"
#include "widgets/viewport/viewport_tool.h"

namespace windfall::widgets {

/// What the tool asks of its host: the links as they stand in the last picture, and what to do with the hand.
class PullHost {
 public:
  virtual ~PullHost() = default;
  virtual const std::vector<LinkCapsule>& pullCapsules() const = 0;
  virtual const std::vector<mat4>& pullPose() const = 0;
  /// Nothing: lets go.
  virtual void pull(const std::optional<sim::Pull>& pull) = 0;
};

/// Press on a branch and drag: it follows the pointer in the plane that faces the eye; released it sways freely.
class PullTool : public ViewportTool {
 public:
  explicit PullTool(PullHost& host) : host_(host) {}
  bool press(const ViewportEvent& event) override;
  void move(const ViewportEvent& event) override;
  void release(const ViewportEvent& event) override;
  void cancel() override;
  void paint(QPainter& painter, const OrbitCamera& camera, QSize size) const override;
  bool isHolding() const { return pull_.has_value(); }

 private:
  PullHost& host_;
  std::optional<sim::Pull> pull_;
  vec3 plane_{0}, normal_{0, 0, 1};
};

}  // namespace windfall::widgets
