// Tools that shape a grown plant by hand: prune, bend, draw, thicken, drag a node, set a part on.
#pragma once

#include <QString>
#include <memory>
#include <optional>
#include <vector>

#include "model/document/document.h"
#include "model/plant/geometry.h"
#include "model/plant/grow/part_library.h"
#include "widgets/viewport/viewport_tool.h"

namespace windfall::widgets {

/// What lies under the pointer: a bone of the plant at rest.
struct PickedBone {
  std::size_t bone = 0;
  vec3 place{0};    ///< on its axis, m
  float share = 0;  ///< 0 its head .. 1 its tail
};

/// What the tools may ask of whoever hosts them. The plant stands at the origin.
class ShapeToolHost {
 public:
  virtual ~ShapeToolHost() = default;
  virtual model::Document& document() = 0;
  virtual model::AssetId plant() const = 0;
  /// Null while there is none, or where it cannot be shaped (then the artist is told why).
  virtual const model::PlantGeometry* shapeable() = 0;
  virtual std::optional<PickedBone> boneAt(const ViewportEvent& event) = 0;
  /// Lights the bones up; empty: none.
  virtual void highlight(const std::vector<std::size_t>& bones) = 0;
  /// The part that the artist has chosen in the library; null: none.
  virtual const model::PlantPart* part() const = 0;
};

class ShapeTool : public ViewportTool {
 public:
  explicit ShapeTool(ShapeToolHost& host) : host_(host) {}
  virtual QString id() const = 0;     ///< names the icon too
  virtual QString title() const = 0;  ///< translated
  virtual QString help() const = 0;   ///< one translated line
  virtual int shortcut() const = 0;   ///< Qt::Key

 protected:
  /// Adds an edit at the end of a bone as one step of undo.
  void add(model::HandEdit edit, std::size_t bone, const QString& text);
  ShapeToolHost& host_;
};

/// In the order of the work.
std::vector<std::unique_ptr<ShapeTool>> makeShapeTools(ShapeToolHost& host);

/// A bone and all that it carries, ascending.
std::vector<std::size_t> carriedBy(const std::vector<model::Bone>& bones, std::size_t first);

/// Fewer points of a line so that none lies farther than `slack` from it (Douglas and Peucker 1973).
std::vector<vec3> simplified(const std::vector<vec3>& line, float slack);

}  // namespace windfall::widgets
