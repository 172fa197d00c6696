#include "widgets/viewport/orbit_camera.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

namespace windfall::widgets {
namespace {

constexpr double kDegrees = std::numbers::pi / 180;
constexpr double kDegreesPerPixel = 0.35;
constexpr double kZoomPerStep = 0.85;
constexpr double kNearest = 0.05, kFarthest = 2000;  // m
constexpr double kLowestEye = 0.12;                  // m above the ground
constexpr double kHighest = 89.9;                    // degrees; straight down would leave "up" undefined

vec3 toVec(const QVector3D& v) { return {v.x(), v.y(), v.z()}; }
QVector3D toQt(vec3 v) { return {v.x, v.y, v.z}; }

}  // namespace

vec3 eyeOf(const model::Camera& camera) {
  const double azimuth = camera.azimuth * kDegrees, elevation = camera.elevation * kDegrees;
  const vec3 back(static_cast<float>(std::sin(azimuth) * std::cos(elevation)), static_cast<float>(std::sin(elevation)),
                  static_cast<float>(std::cos(azimuth) * std::cos(elevation)));
  return toVec(camera.target) + back * static_cast<float>(camera.distance);
}

vec3 OrbitCamera::target() const { return toVec(state_.target); }

OrbitCamera::Axes OrbitCamera::axes() const {
  const vec3 forward = glm::normalize(target() - eye());
  const vec3 right = glm::normalize(glm::cross(forward, vec3(0, 1, 0)));
  return {right, glm::cross(right, forward), forward};
}

void OrbitCamera::keepAboveGround() {
  state_.target.setY(std::max(state_.target.y(), 0.f));
  const double lowest = std::asin(std::clamp((kLowestEye - state_.target.y()) / state_.distance, -1.0, 1.0)) / kDegrees;
  state_.elevation = std::clamp(state_.elevation, std::min(lowest, kHighest), kHighest);
}

void OrbitCamera::orbit(QPointF pixels) {
  state_.azimuth = std::remainder(state_.azimuth - pixels.x() * kDegreesPerPixel, 360.0);
  state_.elevation += pixels.y() * kDegreesPerPixel;
  keepAboveGround();
}

void OrbitCamera::pan(QPointF pixels, QSize size) {
  const Axes a = axes();
  const auto metres = static_cast<float>(pixelSize(target(), size));
  const vec3 moved =
      target() + (a.up * static_cast<float>(pixels.y()) - a.right * static_cast<float>(pixels.x())) * metres;
  state_.target = toQt(moved);
  keepAboveGround();
}

void OrbitCamera::zoom(double steps, QPointF pointer, QSize size) {
  const double wanted = std::clamp(state_.distance * std::pow(kZoomPerStep, steps), kNearest, kFarthest);
  const auto factor = static_cast<float>(wanted / state_.distance);
  const Axes a = axes();
  const Ray through = ray(pointer, size);
  const float reach = static_cast<float>(state_.distance) / std::max(glm::dot(through.direction, a.forward), 1e-3f);
  const vec3 pivot = through.origin + through.direction * reach;
  state_.target = toQt(pivot + (target() - pivot) * factor);
  state_.distance = wanted;
  keepAboveGround();
}

void OrbitCamera::look(StandardView view) {
  switch (view) {
    case StandardView::Front:
      state_.azimuth = 0;
      break;
    case StandardView::Right:
      state_.azimuth = 90;
      break;
    case StandardView::Back:
      state_.azimuth = 180;
      break;
    case StandardView::Left:
      state_.azimuth = -90;
      break;
    case StandardView::Top:
      state_.azimuth = 0;
      break;
  }
  state_.elevation = view == StandardView::Top ? kHighest : 0;
  keepAboveGround();
}

void OrbitCamera::frame(const Box& box, QSize size) {
  constexpr double kFilled = 0.98;       // share of the picture
  constexpr float kLeastExtent = 0.02f;  // m
  const vec3 center = (box.lower + box.upper) / 2.f, half = glm::max((box.upper - box.lower) / 2.f, vec3(kLeastExtent));
  const double tall = std::tan(state_.fieldOfView * kDegrees / 2) * kFilled;
  const double wide = tall * std::max(size.width(), 1) / std::max(size.height(), 1);
  state_.target = toQt(center);
  const Axes a = axes();
  double distance = kNearest;
  for (int corner = 0; corner < 8; ++corner) {
    const vec3 sign(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
    const vec3 d = half * sign;
    const double nearer = -static_cast<double>(glm::dot(d, a.forward));
    distance = std::max({distance, nearer + std::abs(static_cast<double>(glm::dot(d, a.right))) / wide,
                         nearer + std::abs(static_cast<double>(glm::dot(d, a.up))) / tall});
  }
  state_.distance = std::min(distance, kFarthest);
  keepAboveGround();
}

Ray OrbitCamera::ray(QPointF position, QSize size) const {
  const Axes a = axes();
  const double half = std::tan(state_.fieldOfView * kDegrees / 2);
  const double height = std::max(size.height(), 1);
  const auto x = static_cast<float>((2 * position.x() - size.width()) / height * half);
  const auto y = static_cast<float>((height - 2 * position.y()) / height * half);
  return {eye(), glm::normalize(a.forward + a.right * x + a.up * y)};
}

std::optional<QPointF> OrbitCamera::project(vec3 place, QSize size) const {
  const Axes a = axes();
  const vec3 d = place - eye();
  const float depth = glm::dot(d, a.forward);
  if (depth < 1e-3f) return std::nullopt;
  const double half = std::tan(state_.fieldOfView * kDegrees / 2);
  const double height = std::max(size.height(), 1);
  const double x = glm::dot(d, a.right) / (depth * half), y = glm::dot(d, a.up) / (depth * half);
  return QPointF((size.width() + x * height) / 2, (1 - y) * height / 2);
}

double OrbitCamera::pixelSize(vec3 place, QSize size) const {
  const double depth = std::max(glm::dot(place - eye(), axes().forward), 1e-3f);
  return 2 * depth * std::tan(state_.fieldOfView * kDegrees / 2) / std::max(size.height(), 1);
}

model::Camera between(const model::Camera& first, const model::Camera& second, double share) {
  model::Camera camera = second;
  const auto mix = [share](double a, double b) { return a + (b - a) * share; };
  camera.target = first.target + (second.target - first.target) * static_cast<float>(share);
  camera.azimuth = first.azimuth + std::remainder(second.azimuth - first.azimuth, 360.0) * share;
  camera.elevation = mix(first.elevation, second.elevation);
  camera.distance = first.distance * std::pow(second.distance / first.distance, share);
  camera.fieldOfView = mix(first.fieldOfView, second.fieldOfView);
  return camera;
}

}  // namespace windfall::widgets
