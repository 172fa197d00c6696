#include "widgets/plant/pull_tool.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace windfall::widgets {
namespace {
const QColor kHand(0xF2, 0xC1, 0x4E);
constexpr float kFarthest = 50;  // m
}  // namespace

bool PullTool::press(const ViewportEvent& event) {
  const Ray ray = event.camera.ray(event.position, event.size);
  const std::vector<mat4>& pose = host_.pullPose();
  const auto hit = pick(ray, host_.pullCapsules(), pose, pickSlack(event));
  if (!hit || hit->link >= pose.size()) return false;
  const vec3 place = ray.origin + ray.direction * hit->distance;
  sim::Pull pull;
  pull.link = hit->link;
  pull.grab = vec3(glm::inverse(pose[hit->link]) * vec4(place, 1));
  pull.target = place;
  plane_ = place;
  normal_ = glm::normalize(event.camera.target() - event.camera.eye());
  pull_ = pull;
  host_.pull(pull_);
  return true;
}

void PullTool::move(const ViewportEvent& event) {
  if (!pull_) return;
  const Ray ray = event.camera.ray(event.position, event.size);
  const float slope = glm::dot(ray.direction, normal_);
  if (slope < 1e-3f) return;
  vec3 target = ray.origin + ray.direction * (glm::dot(plane_ - ray.origin, normal_) / slope);
  const vec3 way = target - plane_;
  if (const float length = glm::length(way); length > kFarthest) target = plane_ + way * (kFarthest / length);
  target.y = std::max(target.y, 0.02f);
  pull_->target = target;
  host_.pull(pull_);
}

void PullTool::release(const ViewportEvent&) { cancel(); }

void PullTool::cancel() {
  if (!pull_) return;
  pull_.reset();
  host_.pull(std::nullopt);
}

void PullTool::paint(QPainter& painter, const OrbitCamera& camera, QSize size) const {
  if (!pull_ || pull_->link >= host_.pullPose().size()) return;
  const vec3 held(host_.pullPose()[pull_->link] * vec4(pull_->grab, 1));
  const auto from = camera.project(held, size), to = camera.project(pull_->target, size);
  if (!from || !to) return;
  painter.setPen(QPen(QColor(0, 0, 0, 120), 4, Qt::SolidLine, Qt::RoundCap));
  painter.drawLine(*from, *to);
  painter.setPen(QPen(kHand, 2, Qt::SolidLine, Qt::RoundCap));
  painter.drawLine(*from, *to);
  painter.setBrush(kHand);
  painter.setPen(QPen(QColor(0, 0, 0, 140), 1));
  painter.drawEllipse(*from, 4, 4);
  painter.drawEllipse(*to, 6, 6);
}

}  // namespace windfall::widgets
