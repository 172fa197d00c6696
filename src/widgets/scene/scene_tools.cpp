#include "widgets/scene/scene_tools.h"

#include <QCoreApplication>
#include <QPainterPath>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "widgets/scene/fan_tool.h"

namespace windfall::widgets {
namespace {

constexpr double kDegreesPerPixel = 0.5;
constexpr double kSnap = 15;          // degrees
constexpr double kLeastSlope = 0.25;  // sine of the view's elevation: dragging stays tame near the horizon
constexpr double kRing = 0.9;         // m, radius of a tree's ring at scale 1
const QColor kHandle(0xA6, 0xD6, 0x7B);

vec3 placeOf(const model::TreePlacement& tree) { return {tree.position.x(), tree.position.y(), tree.position.z()}; }

/// A circle on the ground round the tree, with a mark where it heads to.
void paintRing(QPainter& painter, const OrbitCamera& camera, QSize size, const model::TreePlacement& tree,
               bool heading) {
  const vec3 center = placeOf(tree);
  const double radius = kRing * tree.scale;
  const auto at = [&](double angle, double reach) {
    return camera.project(
        center + vec3(static_cast<float>(std::sin(angle) * reach), 0.01f, static_cast<float>(std::cos(angle) * reach)),
        size);
  };
  QPainterPath ring;
  constexpr int kSides = 64;
  for (int i = 0; i <= kSides; ++i) {
    const auto point = at(2 * std::numbers::pi * i / kSides, radius);
    if (!point) return;
    i == 0 ? ring.moveTo(*point) : ring.lineTo(*point);
  }
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(QColor(0, 0, 0, 110), 4));
  painter.drawPath(ring);
  painter.setPen(QPen(kHandle, 2));
  painter.drawPath(ring);
  if (!heading) return;
  const double angle = tree.heading * std::numbers::pi / 180;
  const auto from = at(angle, radius), to = at(angle, radius * 1.35);
  if (from && to) painter.drawLine(*from, *to);
  painter.setBrush(kHandle);
  if (to) painter.drawEllipse(*to, 4, 4);
}

}  // namespace

void SelectTreesTool::click(const ViewportEvent& event) {
  const std::vector<sim::Fan>& fans = host_.document().project().scene.wind.fans;
  const FanHit fan = fanAt(event.position, event.camera, event.size, fans);
  host_.selection().setFan(fan.fan);
  if (fan.fan >= 0) return;
  const model::AssetId tree = host_.treeAt(event.camera.ray(event.position, event.size), pickSlack(event), nullptr);
  host_.selection().click(tree, event.modifiers);
}

bool SelectTreesTool::grab(const ViewportEvent& event, vec3* place) {
  const model::AssetId tree = host_.treeAt(event.camera.ray(event.position, event.size), pickSlack(event), place);
  if (!tree) return false;
  if (!host_.selection().contains(tree)) host_.selection().click(tree, event.modifiers);
  return true;
}

void SelectTreesTool::paint(QPainter& painter, const OrbitCamera& camera, QSize size) const {
  paintFans(painter, camera, size, host_.document().project().scene.wind.fans, host_.selection().fan());
  for (const model::AssetId id : host_.selection().trees()) {
    if (const model::TreePlacement* tree = host_.document().project().tree(id)) {
      paintRing(painter, camera, size, *tree, false);
    }
  }
}

bool DragTreesTool::press(const ViewportEvent& event) {
  vec3 place{0};
  return grab(event, &place) && begin(event, place);
}

bool DragTreesTool::begin(const ViewportEvent& event, vec3 place) {
  place_ = place;
  pressed_ = event.position;
  before_ = host_.document().project().scene.trees;
  dragging_ = true;
  ++gesture_;
  return true;
}

void DragTreesTool::apply(const std::vector<model::TreePlacement>& trees) {
  host_.document().setScene(&model::Scene::trees, trees, model::Aspect::SceneTrees, text(),
                            QStringLiteral("%1 %2").arg(text()).arg(gesture_));
}

void DragTreesTool::move(const ViewportEvent& event) {
  if (!dragging_) return;
  std::vector<model::TreePlacement> trees = before_;
  for (model::TreePlacement& tree : trees) {
    if (host_.selection().contains(tree.id)) drag(tree, event);
  }
  apply(trees);
}

void DragTreesTool::release(const ViewportEvent&) { dragging_ = false; }

void DragTreesTool::cancel() {
  if (!std::exchange(dragging_, false)) return;
  apply(before_);
}

void MoveTreesTool::drag(model::TreePlacement& tree, const ViewportEvent& event) const {
  const QPointF moved = event.position - pressed_;
  const double azimuth = event.camera.state().azimuth * std::numbers::pi / 180;
  const double slope = std::max(std::sin(event.camera.state().elevation * std::numbers::pi / 180), kLeastSlope);
  const double metres = event.camera.pixelSize(place_, event.size);
  const double right = moved.x() * metres, back = moved.y() * metres / slope;
  tree.position += QVector3D(static_cast<float>(std::cos(azimuth) * right + std::sin(azimuth) * back), 0,
                             static_cast<float>(-std::sin(azimuth) * right + std::cos(azimuth) * back));
}

QString MoveTreesTool::text() const { return QCoreApplication::translate("MoveTreesTool", "Move trees"); }

bool TurnTreesTool::press(const ViewportEvent& event) {
  if (DragTreesTool::press(event)) return true;
  // The ring's handle lies outside the tree: anywhere near a chosen tree's foot takes the drag too.
  const auto ground = event.camera.ray(event.position, event.size);
  for (const model::AssetId id : host_.selection().trees()) {
    const model::TreePlacement* tree = host_.document().project().tree(id);
    if (tree == nullptr || std::abs(ground.direction.y) < 1e-4f) continue;
    const float along = (tree->position.y() - ground.origin.y) / ground.direction.y;
    const vec3 place = ground.origin + ground.direction * along;
    if (along <= 0 || static_cast<double>(glm::length(place - placeOf(*tree))) > kRing * tree->scale * 1.5) continue;
    return begin(event, place);
  }
  return false;
}

void TurnTreesTool::paint(QPainter& painter, const OrbitCamera& camera, QSize size) const {
  paintFans(painter, camera, size, host_.document().project().scene.wind.fans, host_.selection().fan());
  for (const model::AssetId id : host_.selection().trees()) {
    if (const model::TreePlacement* tree = host_.document().project().tree(id)) {
      paintRing(painter, camera, size, *tree, true);
    }
  }
}

void TurnTreesTool::drag(model::TreePlacement& tree, const ViewportEvent& event) const {
  double heading = tree.heading + (event.position.x() - pressed_.x()) * kDegreesPerPixel;
  if (event.modifiers & Qt::ShiftModifier) heading = std::round(heading / kSnap) * kSnap;
  tree.heading = heading - 360 * std::floor(heading / 360);
}

QString TurnTreesTool::text() const { return QCoreApplication::translate("TurnTreesTool", "Turn trees"); }

}  // namespace windfall::widgets
