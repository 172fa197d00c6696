#include "widgets/viewport/camera_json.h"

#include <QJsonArray>
#include <cmath>

namespace windfall::widgets {

QJsonObject toJson(const model::Camera& camera) {
  return {{"target", QJsonArray{static_cast<double>(camera.target.x()), static_cast<double>(camera.target.y()),
                                static_cast<double>(camera.target.z())}},
          {"azimuth", camera.azimuth},
          {"elevation", camera.elevation},
          {"distance", camera.distance},
          {"fieldOfView", camera.fieldOfView}};
}

std::optional<model::Camera> cameraFromJson(const QJsonObject& object) {
  model::Camera camera;
  const QJsonArray target = object["target"].toArray();
  if (target.size() != 3) return std::nullopt;
  const auto number = [](const QJsonValue& value) { return value.toDouble(std::nan("")); };
  const double x = number(target[0]), y = number(target[1]), z = number(target[2]);
  camera.azimuth = number(object["azimuth"]);
  camera.elevation = number(object["elevation"]);
  camera.distance = number(object["distance"]);
  camera.fieldOfView = number(object["fieldOfView"]);
  for (const double value : {x, y, z, camera.azimuth}) {
    if (!(std::abs(value) < 1e6)) return std::nullopt;
  }
  if (!(std::abs(camera.elevation) < 90) || !(camera.distance > 1e-3 && camera.distance < 1e5)) return std::nullopt;
  if (!(camera.fieldOfView > 1 && camera.fieldOfView < 150)) return std::nullopt;
  camera.target = {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
  return camera;
}

}  // namespace windfall::widgets
