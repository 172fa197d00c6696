#include "widgets/tools/shape_tools.h"

#include <QCoreApplication>
#include <QPainter>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/plant/grow/grow_skeleton.h"

namespace windfall::widgets {

namespace {

QString say(const char* text) { return QCoreApplication::translate("ShapeTool", text); }

QVector3D toQt(vec3 v) { return {v.x, v.y, v.z}; }

/// Where a ray meets the plane through `place` that faces the camera.
std::optional<vec3> meetFacing(const ViewportEvent& event, vec3 place) {
  const Ray ray = event.camera.ray(event.position, event.size);
  const vec3 facing = glm::normalize(event.camera.eye() - place);
  const float along = glm::dot(ray.direction, facing);
  if (std::abs(along) < 1e-5f) return {};
  const float distance = glm::dot(place - ray.origin, facing) / along;
  return distance > 0 ? std::optional<vec3>(ray.origin + distance * ray.direction) : std::nullopt;
}

void drawLine(QPainter& painter, const OrbitCamera& camera, QSize size, vec3 a, vec3 b) {
  const auto from = camera.project(a, size), to = camera.project(b, size);
  if (from && to) painter.drawLine(*from, *to);
}

void setPen(QPainter& painter, double width) {
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(QColor(255, 214, 92), width, Qt::SolidLine, Qt::RoundCap));
  painter.setBrush(Qt::NoBrush);
}

class Prune : public ShapeTool {
 public:
  using ShapeTool::ShapeTool;
  QString id() const override { return QStringLiteral("prune"); }
  QString title() const override { return say("Prune"); }
  QString help() const override { return say("Click a branch to cut it off there; what it carries falls with it."); }
  int shortcut() const override { return Qt::Key_X; }
  bool press(const ViewportEvent& event) override {
    const model::PlantGeometry* geometry = host_.shapeable();
    picked_ = geometry ? host_.boneAt(event) : std::nullopt;
    if (!picked_) return false;
    host_.highlight(carriedBy(geometry->bones, picked_->bone));
    return true;
  }
  void release(const ViewportEvent& event) override {
    const std::optional<PickedBone> last = std::exchange(picked_, {});
    const std::optional<PickedBone> now = host_.boneAt(event);
    host_.highlight({});
    // Let go elsewhere: the cut was thought better of.
    if (!last || !now || now->bone != last->bone) return;
    model::HandEdit edit;
    edit.kind = model::HandEditKind::Prune;
    edit.stub = static_cast<double>(last->share);
    add(edit, last->bone, say("Prune a branch"));
  }
  void cancel() override {
    picked_.reset();
    host_.highlight({});
  }

 private:
  std::optional<PickedBone> picked_;
};

/// What a drag on a branch has in common: what it carries is drawn as it would be.
class DragBranch : public ShapeTool {
 public:
  using ShapeTool::ShapeTool;
  bool press(const ViewportEvent& event) override {
    const model::PlantGeometry* geometry = host_.shapeable();
    picked_ = geometry ? host_.boneAt(event) : std::nullopt;
    if (!picked_) return false;
    pressed_ = now_ = event.position;
    carried_ = carriedBy(geometry->bones, picked_->bone);
    host_.highlight(carried_);
    begin(event, *geometry);
    return true;
  }
  void move(const ViewportEvent& event) override {
    if (!picked_) return;
    now_ = event.position;
    follow(event);
  }
  void release(const ViewportEvent& event) override {
    if (!picked_) return;
    move(event);
    host_.highlight({});
    const PickedBone picked = *std::exchange(picked_, {});
    if ((now_ - pressed_).manhattanLength() >= 3) finish(picked);
  }
  void cancel() override {
    picked_.reset();
    host_.highlight({});
  }
  void paint(QPainter& painter, const OrbitCamera& camera, QSize size) const override {
    const model::PlantGeometry* geometry = picked_ ? host_.shapeable() : nullptr;
    if (geometry == nullptr) return;
    setPen(painter, 1.6);
    for (const std::size_t bone : carried_) {
      if (bone < geometry->bones.size())
        drawLine(painter, camera, size, shaped(geometry->bones[bone].head), shaped(geometry->bones[bone].tail));
    }
    if (const QString text = state(); !text.isEmpty()) painter.drawText(now_ + QPointF(14, -8), text);
  }

 protected:
  virtual void begin(const ViewportEvent&, const model::PlantGeometry&) {}
  virtual void follow(const ViewportEvent&) {}
  virtual void finish(const PickedBone& picked) = 0;
  virtual vec3 shaped(vec3 place) const { return place; }
  virtual QString state() const { return {}; }
  std::optional<PickedBone> picked_;
  QPointF pressed_, now_;
  std::vector<std::size_t> carried_;
};

class Bend : public DragBranch {
 public:
  using DragBranch::DragBranch;
  QString id() const override { return QStringLiteral("bend"); }
  QString title() const override { return say("Bend"); }
  QString help() const override { return say("Drag a branch to turn it about the place where it begins."); }
  int shortcut() const override { return Qt::Key_B; }

 protected:
  void begin(const ViewportEvent& event, const model::PlantGeometry& geometry) override {
    pivot_ = geometry.bones[picked_->bone].head;
    grabbed_ = picked_->place;
    // Near its base a branch would whirl: the grip is at least as far out as its link is long.
    if (glm::length(grabbed_ - pivot_) < 0.02f) grabbed_ = geometry.bones[picked_->bone].tail;
    axis_ = glm::normalize(event.camera.eye() - pivot_);
    angle_ = 0;
  }
  void follow(const ViewportEvent& event) override {
    const std::optional<vec3> to = meetFacing(event, grabbed_);
    if (!to) return;
    const vec3 from = grabbed_ - pivot_, now = *to - pivot_;
    const vec3 cross = glm::cross(from, now);
    if (glm::length(cross) < 1e-7f) return;
    axis_ = glm::normalize(cross);
    angle_ = std::atan2(glm::length(cross), glm::dot(from, now));
  }
  vec3 shaped(vec3 place) const override { return pivot_ + glm::angleAxis(angle_, axis_) * (place - pivot_); }
  QString state() const override { return QStringLiteral("%1°").arg(qRound(angle_ * 180 / std::numbers::pi_v<float>)); }
  void finish(const PickedBone& picked) override {
    if (std::abs(angle_) < 0.002f) return;
    model::HandEdit edit;
    edit.kind = model::HandEditKind::Bend;
    edit.axis = toQt(axis_);
    edit.angle = static_cast<double>(angle_) * 180 / std::numbers::pi;
    add(edit, picked.bone, say("Bend a branch"));
  }

 private:
  vec3 pivot_{0}, grabbed_{0}, axis_{0, 0, 1};
  float angle_ = 0;
};

class Thicken : public DragBranch {
 public:
  using DragBranch::DragBranch;
  QString id() const override { return QStringLiteral("thicken"); }
  QString title() const override { return say("Thickness"); }
  QString help() const override { return say("Drag a branch to the right to make it thicker, to the left thinner."); }
  int shortcut() const override { return Qt::Key_T; }

 protected:
  double factor() const { return std::clamp(std::exp((now_.x() - pressed_.x()) / 160), 0.1, 10.0); }
  QString state() const override { return QStringLiteral("× %1").arg(factor(), 0, 'f', 2); }
  void finish(const PickedBone& picked) override {
    model::HandEdit edit;
    edit.kind = model::HandEditKind::Thicken;
    edit.factor = factor();
    add(edit, picked.bone, say("Change a branch's thickness"));
  }
};

/// Handles on a branch's curve: the ends of its links.
class MoveNode : public DragBranch {
 public:
  using DragBranch::DragBranch;
  QString id() const override { return QStringLiteral("handle"); }
  QString title() const override { return say("Handles"); }
  QString help() const override { return say("Drag a node of a branch's curve; its neighbours follow."); }
  int shortcut() const override { return Qt::Key_C; }
  void paint(QPainter& painter, const OrbitCamera& camera, QSize size) const override {
    DragBranch::paint(painter, camera, size);
    const model::PlantGeometry* geometry = host_.shapeable();
    if (geometry == nullptr) return;
    setPen(painter, 1.2);
    painter.setBrush(QColor(30, 30, 30, 180));
    // Fine twigs would be all handles: only wood that is seen as more than a line.
    for (const model::Bone& bone : geometry->bones) {
      if (camera.pixelSize(bone.tail, size) > 0.6 * static_cast<double>(bone.radius)) continue;
      if (const auto place = camera.project(bone.tail, size)) painter.drawEllipse(*place, 3.2, 3.2);
    }
    if (picked_) {
      if (const auto place = camera.project(node_ + offset_, size)) painter.drawEllipse(*place, 6, 6);
    }
  }

 protected:
  void begin(const ViewportEvent&, const model::PlantGeometry& geometry) override {
    const model::Bone& bone = geometry.bones[picked_->bone];
    // The nearer end of the link is what is dragged.
    if (picked_->share < 0.5f && bone.parent >= 0 &&
        glm::length(geometry.bones[static_cast<std::size_t>(bone.parent)].tail - bone.head) < 1e-4f) {
      picked_->bone = static_cast<std::size_t>(bone.parent);
      carried_ = carriedBy(geometry.bones, picked_->bone);
    }
    node_ = geometry.bones[picked_->bone].tail;
    offset_ = vec3(0);
  }
  void follow(const ViewportEvent& event) override {
    ViewportEvent before = event;
    const std::optional<vec3> to = meetFacing(event, node_);
    before.position = pressed_;
    const std::optional<vec3> from = meetFacing(before, node_);
    if (to && from) offset_ = *to - *from;
  }
  vec3 shaped(vec3 place) const override { return place + offset_; }
  void finish(const PickedBone& picked) override {
    model::HandEdit edit;
    edit.kind = model::HandEditKind::Move;
    edit.offset = toQt(offset_);
    add(edit, picked.bone, say("Drag a node"));
  }

 private:
  vec3 node_{0}, offset_{0};
};

class DrawBranch : public ShapeTool {
 public:
  using ShapeTool::ShapeTool;
  QString id() const override { return QStringLiteral("draw-branch"); }
  QString title() const override { return say("Draw"); }
  QString help() const override { return say("Draw a new branch from where you press on the plant."); }
  int shortcut() const override { return Qt::Key_D; }
  bool press(const ViewportEvent& event) override {
    picked_ = host_.shapeable() ? host_.boneAt(event) : std::nullopt;
    if (!picked_) return false;
    start_ = host_.shapeable()->bones[picked_->bone].tail;
    line_ = {start_};
    return true;
  }
  void move(const ViewportEvent& event) override {
    if (!picked_) return;
    const std::optional<vec3> place = meetFacing(event, start_);
    if (place &&
        glm::length(*place - line_.back()) > 4 * static_cast<float>(event.camera.pixelSize(start_, event.size)))
      line_.push_back(*place);
    pixel_ = static_cast<float>(event.camera.pixelSize(start_, event.size));
  }
  void release(const ViewportEvent& event) override {
    move(event);
    if (!picked_) return;
    const PickedBone picked = *std::exchange(picked_, {});
    std::vector<vec3> line = simplified(line_, 2.5f * pixel_);
    line_.clear();
    if (line.size() < 2 || glm::length(line.back() - start_) < 8 * pixel_) return;
    model::HandEdit edit;
    edit.kind = model::HandEditKind::Draw;
    for (std::size_t i = 1; i < line.size(); ++i)
      edit.line.push_back(toQt({line[i].x, std::max(line[i].y, 0.05f), line[i].z}));
    add(edit, picked.bone, say("Draw a branch"));
  }
  void cancel() override {
    picked_.reset();
    line_.clear();
  }
  void paint(QPainter& painter, const OrbitCamera& camera, QSize size) const override {
    setPen(painter, 2.4);
    for (std::size_t i = 1; i < line_.size(); ++i) drawLine(painter, camera, size, line_[i - 1], line_[i]);
  }

 private:
  std::optional<PickedBone> picked_;
  vec3 start_{0};
  std::vector<vec3> line_;
  float pixel_ = 0.001f;
};

/// Sets the library's chosen part on; the drag points where it grows to.
class SetPart : public ShapeTool {
 public:
  using ShapeTool::ShapeTool;
  QString id() const override { return QStringLiteral("graft"); }
  QString title() const override { return say("Set a part on"); }
  QString help() const override {
    return say("Press on the plant and drag to where the library's chosen part shall point.");
  }
  int shortcut() const override { return Qt::Key_P; }
  bool press(const ViewportEvent& event) override {
    const model::PlantGeometry* geometry = host_.part() ? host_.shapeable() : nullptr;
    picked_ = geometry ? host_.boneAt(event) : std::nullopt;
    if (!picked_) return false;
    base_ = geometry->bones[picked_->bone].tail;
    tip_ = base_;
    return true;
  }
  void move(const ViewportEvent& event) override {
    if (const std::optional<vec3> to = picked_ ? meetFacing(event, base_) : std::nullopt) tip_ = *to;
  }
  void release(const ViewportEvent& event) override {
    move(event);
    if (!picked_ || host_.part() == nullptr) return;
    const PickedBone picked = *std::exchange(picked_, {});
    model::HandEdit edit;
    edit.kind = model::HandEditKind::Graft;
    edit.offset = glm::length(tip_ - base_) > 1e-3f ? toQt(tip_ - base_) : QVector3D(0, 1, 0);
    edit.part = host_.part()->nodes;
    add(edit, picked.bone, say("Set a part on"));
  }
  void cancel() override { picked_.reset(); }
  void paint(QPainter& painter, const OrbitCamera& camera, QSize size) const override {
    if (!picked_) return;
    setPen(painter, 2);
    drawLine(painter, camera, size, base_, tip_);
  }

 private:
  std::optional<PickedBone> picked_;
  vec3 base_{0}, tip_{0};
};

void keepFar(const std::vector<vec3>& line, std::size_t from, std::size_t to, float slack, std::vector<char>& keep) {
  std::size_t worst = from;
  float most = slack;
  const vec3 along = line[to] - line[from];
  for (std::size_t i = from + 1; i < to; ++i) {
    const vec3 way = line[i] - line[from];
    const float t =
        glm::dot(along, along) > 0 ? std::clamp(glm::dot(way, along) / glm::dot(along, along), 0.0f, 1.0f) : 0;
    const float distance = glm::length(way - t * along);
    if (distance > most) most = distance, worst = i;
  }
  if (worst == from) return;
  keep[worst] = 1;
  keepFar(line, from, worst, slack, keep);
  keepFar(line, worst, to, slack, keep);
}

}  // namespace

void ShapeTool::add(model::HandEdit edit, std::size_t bone, const QString& text) {
  const model::PlantGeometry* geometry = host_.shapeable();
  const model::Plant* plant = host_.document().project().plant(host_.plant());
  if (geometry == nullptr || plant == nullptr || bone >= geometry->bones.size()) return;
  edit.place = toQt(geometry->bones[bone].tail);
  if (plant->grower) edit.age = plant->grower->age;
  // A file's skeleton is shaped as it was read, before it is scaled.
  if (!plant->file.isEmpty()) model::growth::scaleEdit(edit, 1 / plant->surface.scale);
  std::vector<model::HandEdit> edits = plant->handEdits;
  edits.push_back(std::move(edit));
  host_.document().setPlant(host_.plant(), &model::Plant::handEdits, std::move(edits), model::Aspect::PlantSource,
                            text);
}

std::vector<std::unique_ptr<ShapeTool>> makeShapeTools(ShapeToolHost& host) {
  std::vector<std::unique_ptr<ShapeTool>> tools;
  tools.push_back(std::make_unique<Prune>(host));
  tools.push_back(std::make_unique<Bend>(host));
  tools.push_back(std::make_unique<DrawBranch>(host));
  tools.push_back(std::make_unique<Thicken>(host));
  tools.push_back(std::make_unique<MoveNode>(host));
  tools.push_back(std::make_unique<SetPart>(host));
  return tools;
}

std::vector<std::size_t> carriedBy(const std::vector<model::Bone>& bones, std::size_t first) {
  std::vector<char> inside(bones.size(), 0);
  std::vector<std::size_t> all;
  for (std::size_t b = first; b < bones.size(); ++b) {
    inside[b] = b == first || (bones[b].parent >= 0 && inside[static_cast<std::size_t>(bones[b].parent)]);
    if (inside[b]) all.push_back(b);
  }
  return all;
}

std::vector<vec3> simplified(const std::vector<vec3>& line, float slack) {
  if (line.size() < 3) return line;
  std::vector<char> keep(line.size(), 0);
  keep.front() = keep.back() = 1;
  keepFar(line, 0, line.size() - 1, slack, keep);
  std::vector<vec3> result;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (keep[i]) result.push_back(line[i]);
  }
  return result;
}

}  // namespace windfall::widgets
