// The viewport's camera: turns about a point, and maps between the screen and the world.
#pragma once

#include <QPointF>
#include <QSize>
#include <optional>

#include "kernels/math.h"
#include "model/document/project.h"

namespace windfall::widgets {

/// A half-line in world space; `direction` has length 1.
struct Ray {
  vec3 origin{0};
  vec3 direction{0, 0, -1};
};

/// An axis-aligned box in world space, metres.
struct Box {
  vec3 lower{0}, upper{0};
};

/// The numpad views of Blender: the side of the scene that faces the viewer.
enum class StandardView { Front, Back, Right, Left, Top };

/// Where the eye of `camera` stands, world space.
vec3 eyeOf(const model::Camera& camera);

/// A value: every call moves it at once, smooth motion is the viewport's affair. Positions are in widget pixels from
/// the top left of a picture of the size `size`.
class OrbitCamera {
 public:
  OrbitCamera() = default;
  explicit OrbitCamera(const model::Camera& state) : state_(state) {}

  const model::Camera& state() const { return state_; }
  vec3 eye() const { return eyeOf(state_); }
  vec3 target() const;

  /// Turns with the pointer; the eye stays above the ground.
  void orbit(QPointF pixels);
  /// Moves so that what lies in the target's plane follows the pointer; the target stays above the ground.
  void pan(QPointF pixels, QSize size);
  /// Nearer by `steps` wheel notches (negative: farther); what lies under the pointer stays there.
  void zoom(double steps, QPointF pointer, QSize size);
  void look(StandardView view);
  /// Shows the whole box, from the same side.
  void frame(const Box& box, QSize size);

  Ray ray(QPointF position, QSize size) const;
  /// Nothing for what lies behind the eye.
  std::optional<QPointF> project(vec3 place, QSize size) const;
  /// Metres that a pixel covers at `place`.
  double pixelSize(vec3 place, QSize size) const;

 private:
  struct Axes {
    vec3 right, up, forward;
  };
  Axes axes() const;
  void keepAboveGround();

  model::Camera state_;
};

/// Between two cameras, the short way round; `share` 0 gives the first and 1 the second.
model::Camera between(const model::Camera& first, const model::Camera& second, double share);

}  // namespace windfall::widgets
