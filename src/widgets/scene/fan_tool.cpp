#include "widgets/scene/fan_tool.h"

#include <QCoreApplication>
#include <QPainterPath>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "widgets/viewport/picking.h"

namespace windfall::widgets {
namespace {

constexpr double kBodyReach = 16, kTipReach = 12;  // px
constexpr float kHeight = 2;                       // m of a new fan above the ground
const QColor kFan(0x7F, 0xC8, 0xF0);

vec3 axisOf(const sim::Fan& fan) {
  const float length = glm::length(fan.direction);
  return length > 1e-6f ? fan.direction / length : vec3(1, 0, 0);
}

float arrowOf(const sim::Fan& fan) { return std::max(1.2f, 2.2f * fan.radius); }

/// Two directions across the axis.
void sides(const vec3& axis, vec3& x, vec3& y) {
  x = glm::normalize(glm::cross(axis, std::abs(axis.y) < 0.95f ? vec3(0, 1, 0) : vec3(1, 0, 0)));
  y = glm::cross(x, axis);
}

QPainterPath ring(const OrbitCamera& camera, QSize size, const vec3& centre, const vec3& axis, float radius) {
  vec3 x, y;
  sides(axis, x, y);
  QPainterPath path;
  constexpr int kSides = 40;
  for (int i = 0; i <= kSides; ++i) {
    const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / kSides;
    const auto point = camera.project(centre + radius * (std::cos(angle) * x + std::sin(angle) * y), size);
    if (!point) return {};
    i == 0 ? path.moveTo(*point) : path.lineTo(*point);
  }
  return path;
}

QPainterPath blades(const OrbitCamera& camera, QSize size, const sim::Fan& fan) {
  vec3 x, y;
  sides(axisOf(fan), x, y);
  QPainterPath path;
  for (int blade = 0; blade < 3; ++blade) {
    const auto at = [&](float share, float turn) {
      const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(blade) / 3 + turn;
      return camera.project(fan.position + share * fan.radius * (std::cos(angle) * x + std::sin(angle) * y), size);
    };
    const auto from = at(0.1f, 0), left = at(0.85f, 0.45f), right = at(0.85f, -0.15f);
    if (!from || !left || !right) return {};
    path.moveTo(*from);
    path.lineTo(*left);
    path.lineTo(*right);
    path.closeSubpath();
  }
  return path;
}

void paintFan(QPainter& painter, const OrbitCamera& camera, QSize size, const sim::Fan& fan, bool chosen) {
  const vec3 axis = axisOf(fan);
  QColor color = fan.on ? kFan : QColor(150, 150, 150);
  color.setAlpha(chosen ? 255 : 170);
  const QColor shade(0, 0, 0, chosen ? 120 : 70);
  const auto stroke = [&](const QPainterPath& path, double width) {
    painter.strokePath(path, QPen(shade, width + 2, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    painter.strokePath(path, QPen(color, width, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  };
  painter.setBrush(Qt::NoBrush);
  // Its foot on the ground tells where it stands.
  QPainterPath pole;
  const auto foot = camera.project(vec3(fan.position.x, 0, fan.position.z), size);
  const auto middle = camera.project(fan.position, size);
  if (!middle) return;
  if (foot) {
    pole.moveTo(*foot);
    pole.lineTo(*middle);
    painter.strokePath(pole, QPen(QColor(color.red(), color.green(), color.blue(), 120), 1, Qt::DashLine));
    painter.strokePath(ring(camera, size, vec3(fan.position.x, 0, fan.position.z), vec3(0, 1, 0), 0.12f),
                       QPen(QColor(color.red(), color.green(), color.blue(), 120), 1));
  }
  QColor fill = color;
  fill.setAlpha(chosen ? 110 : 60);
  painter.fillPath(blades(camera, size, fan), fill);
  stroke(ring(camera, size, fan.position, axis, fan.radius), chosen ? 2 : 1.5);
  if (chosen) {
    // The jet widens as far as half of its speed is left.
    const float slope = std::tan(fan.spread * std::numbers::pi_v<float> / 180),
                reach = std::min(8.f, fan.radius / std::max(slope, 0.05f));
    const float wide = fan.radius + slope * reach;
    vec3 x, y;
    sides(axis, x, y);
    QPainterPath jet = ring(camera, size, fan.position + reach * axis, axis, wide);
    for (const vec3& side : {x, -x, y, -y}) {
      const auto a = camera.project(fan.position + fan.radius * side, size);
      const auto b = camera.project(fan.position + reach * axis + wide * side, size);
      if (!a || !b) continue;
      jet.moveTo(*a);
      jet.lineTo(*b);
    }
    painter.strokePath(jet, QPen(QColor(color.red(), color.green(), color.blue(), 110), 1, Qt::DotLine));
  }
  const auto tip = camera.project(fanTip(fan), size);
  if (!tip) return;
  QPainterPath arrow;
  arrow.moveTo(*middle);
  arrow.lineTo(*tip);
  stroke(arrow, 2);
  painter.setPen(QPen(shade, 1));
  painter.setBrush(color);
  painter.drawEllipse(*tip, chosen ? 5 : 3.5, chosen ? 5 : 3.5);
  painter.drawEllipse(*middle, chosen ? 4 : 3, chosen ? 4 : 3);
}

}  // namespace

vec3 fanTip(const sim::Fan& fan) { return fan.position + arrowOf(fan) * axisOf(fan); }

void paintFans(QPainter& painter, const OrbitCamera& camera, QSize size, const std::vector<sim::Fan>& fans,
               int chosen) {
  for (std::size_t i = 0; i < fans.size(); ++i) paintFan(painter, camera, size, fans[i], static_cast<int>(i) == chosen);
}

FanHit fanAt(QPointF position, const OrbitCamera& camera, QSize size, const std::vector<sim::Fan>& fans) {
  FanHit best;
  double nearest = 1;
  const auto consider = [&](const std::optional<QPointF>& place, double reach, FanHit hit) {
    if (!place) return;
    const double share = std::hypot(place->x() - position.x(), place->y() - position.y()) / reach;
    if (share < nearest) nearest = share, best = hit;
  };
  for (std::size_t i = 0; i < fans.size(); ++i) {
    const auto middle = camera.project(fans[i].position, size);
    consider(camera.project(fanTip(fans[i]), size), kTipReach, {static_cast<int>(i), true});
    const double outlet = static_cast<double>(fans[i].radius) / camera.pixelSize(fans[i].position, size);
    consider(middle, std::max(kBodyReach, outlet), {static_cast<int>(i), false});
  }
  return best;
}

const std::vector<sim::Fan>& FanTool::fans() const { return host_.document().project().scene.wind.fans; }

void FanTool::apply(std::vector<sim::Fan> fans, const QString& text, const QString& merge) {
  sim::WindSettings wind = host_.document().project().scene.wind;
  wind.fans = std::move(fans);
  host_.document().setScene(&model::Scene::wind, wind, model::Aspect::Wind, text, merge);
}

bool FanTool::press(const ViewportEvent& event) {
  grip_ = fanAt(event.position, event.camera, event.size, fans());
  if (grip_.fan < 0) return false;
  host_.selection().setFan(grip_.fan);
  before_ = fans();
  pressed_ = event.position;
  dragging_ = true;
  ++gesture_;
  return true;
}

void FanTool::move(const ViewportEvent& event) {
  if (!dragging_ || grip_.fan >= static_cast<int>(before_.size())) return;
  std::vector<sim::Fan> fans = before_;
  sim::Fan& fan = fans[static_cast<std::size_t>(grip_.fan)];
  const QPointF moved = event.position - pressed_;
  const auto up = static_cast<float>(-moved.y() * event.camera.pixelSize(fan.position, event.size));
  const auto planeAt = [&](QPointF pixel) {
    return meetGround(event.camera.ray(pixel, event.size), grip_.arrow ? fanTip(fan).y : fan.position.y);
  };
  QString text;
  if (grip_.arrow) {
    text = QCoreApplication::translate("FanTool", "Turn a fan");
    vec3 to = fanTip(fan) - fan.position;
    if (event.modifiers & Qt::ShiftModifier) {
      to.y += up;
    } else if (const auto from = planeAt(pressed_), now = planeAt(event.position); from && now) {
      to += *now - *from;
    }
    if (glm::length(to) < 1e-3f) return;
    fan.direction = glm::normalize(to);
  } else {
    text = QCoreApplication::translate("FanTool", "Move a fan");
    if (event.modifiers & Qt::ShiftModifier) {
      fan.position.y = std::max(0.1f, fan.position.y + up);
    } else if (const auto from = planeAt(pressed_), now = planeAt(event.position); from && now) {
      fan.position += *now - *from;
    } else {
      // The eye stands level with the fan: it follows the pointer across the view.
      const double azimuth = event.camera.state().azimuth * std::numbers::pi / 180;
      const double right = moved.x() * event.camera.pixelSize(fan.position, event.size);
      fan.position +=
          vec3(static_cast<float>(std::cos(azimuth) * right), 0, static_cast<float>(-std::sin(azimuth) * right));
    }
  }
  apply(std::move(fans), text, QStringLiteral("fan %1").arg(gesture_));
}

void FanTool::release(const ViewportEvent&) { dragging_ = false; }

void FanTool::cancel() {
  if (!std::exchange(dragging_, false)) return;
  apply(before_, QCoreApplication::translate("FanTool", "Move a fan"), QStringLiteral("fan %1").arg(gesture_));
}

void FanTool::click(const ViewportEvent& event) {
  const Ray ray = event.camera.ray(event.position, event.size);
  if (const auto ground = meetGround(ray, 0); ground && glm::length(*ground - event.camera.eye()) < 200)
    placeFan(*ground);
}

void FanTool::placeFan(vec3 ground) {
  const model::Scene& scene = host_.document().project().scene;
  sim::Fan fan;
  fan.position = vec3(ground.x, kHeight, ground.z);
  fan.direction = scene.wind.direction;
  float nearest = 1e30f;
  for (const model::TreePlacement& tree : scene.trees) {
    const vec3 to(tree.position.x() - ground.x, 0, tree.position.z() - ground.z);
    if (glm::length(to) > 0.3f && glm::length(to) < nearest) nearest = glm::length(to), fan.direction = to / nearest;
  }
  std::vector<sim::Fan> all = fans();
  all.push_back(fan);
  apply(std::move(all), QCoreApplication::translate("FanTool", "Place a fan"), {});
  host_.selection().setFan(static_cast<int>(fans().size()) - 1);
}

void FanTool::removeChosen() {
  const int chosen = host_.selection().fan();
  if (chosen < 0 || chosen >= static_cast<int>(fans().size())) return;
  std::vector<sim::Fan> all = fans();
  all.erase(all.begin() + chosen);
  host_.selection().setFan(-1);
  apply(std::move(all), QCoreApplication::translate("FanTool", "Remove a fan"), {});
}

void FanTool::paint(QPainter& painter, const OrbitCamera& camera, QSize size) const {
  paintFans(painter, camera, size, fans(), host_.selection().fan());
}

}  // namespace windfall::widgets
